#include "spume/config/read_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spume/config/keys.hpp"
#include "spume/config/nearest.hpp"
#include "spume/config/text.hpp"
#include "spume/config/value_text.hpp"

namespace spume::config {

namespace {

/// What is wrong with a value, to follow the name of the key; nothing when it is right.
using Complaint = std::optional<std::string>;

std::optional<double> number_in(const toml::node& node) {
  const auto value = node.value<double>();
  if (!node.is_number() || !value || !std::isfinite(*value)) return std::nullopt;
  return value;
}

Complaint must_be(const std::string& what, const toml::node& node) {
  return " must be " + what + ", not " + described(node);
}

std::string with_range(const std::string& what, const Range& range) {
  const std::string text = range_text(range);
  return text.empty() ? what : what + " " + text;
}

std::optional<int> whole_number_in(const toml::node& node, int lowest) {
  if (!node.is_integer()) return std::nullopt;
  const std::int64_t value = node.as_integer()->get();
  if (value < lowest || value > std::numeric_limits<int>::max()) return std::nullopt;
  return static_cast<int>(value);
}

/// The three components of an array, each by `component`; nothing when there are not three or one is wrong.
template <class Component, class Result>
bool read_triple(const toml::node& node, Result& result, const Component& component) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3) return false;
  Result read = result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = component((*array)[axis]);
    if (!value) return false;
    read[axis] = *value;
  }
  result = read;
  return true;
}

template <class Record>
Complaint assign(const Text<Record>& kind, const toml::node& node, Record& record) {
  if (!node.is_string()) return must_be("text", node);
  kind.member(record) = node.as_string()->get();
  return {};
}

template <class Record>
Complaint assign(const Flag<Record>& kind, const toml::node& node, Record& record) {
  if (!node.is_boolean()) return must_be("true or false", node);
  kind.member(record) = node.as_boolean()->get();
  return {};
}

template <class Record>
Complaint assign(const Number<Record>& kind, const toml::node& node, Record& record) {
  const auto value = number_in(node);
  if (!value || !kind.range.contains(*value)) return must_be(with_range("a number", kind.range), node);
  kind.member(record) = *value;
  return {};
}

template <class Record>
Complaint assign(const WholeNumber<Record>& kind, const toml::node& node, Record& record) {
  const auto value = whole_number_in(node, kind.lowest);
  if (!value) return must_be(fmt::format("a whole number ≥ {}", kind.lowest), node);
  kind.member(record) = *value;
  return {};
}

template <class Record>
Complaint assign(const Seed<Record>& kind, const toml::node& node, Record& record) {
  if (!node.is_integer() || node.as_integer()->get() < 0) return must_be("a whole number ≥ 0", node);
  kind.member(record) = static_cast<std::uint64_t>(node.as_integer()->get());
  return {};
}

Complaint assign_vector(const Range& range, const toml::node& node, Vec3& vector) {
  const auto component = [&](const toml::node& n) {
    const auto value = number_in(n);
    return value && range.contains(*value) ? value : std::nullopt;
  };
  if (read_triple(node, vector, component)) return {};
  return must_be(with_range("an array of three numbers", range), node);
}

template <class Record>
Complaint assign(const Vector<Record>& kind, const toml::node& node, Record& record) {
  return assign_vector(kind.range, node, kind.member(record));
}

template <class Record>
Complaint assign(const OptionalVector<Record>& kind, const toml::node& node, Record& record) {
  Vec3 vector;
  Complaint complaint = assign_vector(any_number(), node, vector);
  if (!complaint) kind.member(record) = vector;
  return complaint;
}

template <class Record>
Complaint assign(const Counts<Record>& kind, const toml::node& node, Record& record) {
  const auto component = [&](const toml::node& n) { return whole_number_in(n, kind.lowest); };
  if (read_triple(node, kind.member(record), component)) return {};
  return must_be(fmt::format("an array of three whole numbers ≥ {}", kind.lowest), node);
}

template <class Record>
Complaint assign(const PhasePairs<Record>& kind, const toml::node& node, Record& record) {
  const std::string expected = "a list of pairs of phases, as in [[1, 2], [0, 3]]";
  const toml::array* pairs = node.as_array();
  if (pairs == nullptr) return must_be(expected, node);
  std::vector<std::array<int, 2>> read;
  for (const toml::node& element : *pairs) {
    const toml::array* pair = element.as_array();
    if (pair == nullptr || pair->size() != 2) return must_be(expected, node);
    const auto a = whole_number_in((*pair)[0], 0), b = whole_number_in((*pair)[1], 0);
    if (!a || !b) return must_be(expected, node);
    read.push_back({*a, *b});
  }
  kind.member(record) = read;
  return {};
}

/// The place of a name in the list of a choice, or what is wrong with it.
template <class Record>
Complaint find_name(const Choice<Record>& kind, const toml::node& node, int& place) {
  const std::string names = joined(kind.names, "\", \"");
  const std::string expected = (kind.names.size() == 1 ? "\"" : "one of \"") + names + "\"";
  if (!node.is_string()) return must_be(expected, node);
  const std::string& name = node.as_string()->get();
  const auto found = std::ranges::find(kind.names, name);
  if (found == kind.names.end())
    return *must_be(expected, node) + did_you_mean(nearest_names(name, kind.names));
  place = static_cast<int>(found - kind.names.begin());
  return {};
}

template <class Record>
Complaint assign(const Choice<Record>& kind, const toml::node& node, Record& record) {
  std::vector<int> chosen;
  if (kind.count == 1) {
    chosen.resize(1);
    if (Complaint complaint = find_name(kind, node, chosen.front())) return complaint;
    kind.set(record, chosen);
    return {};
  }
  const bool any_count = kind.count == Choice<Record>::any_count;
  const std::string names = fmt::format("\"{}\"", joined(kind.names, "\", \""));
  const std::string expected = any_count ? "a list of one or more of " + names
                                         : fmt::format("an array of {} of {}", kind.count, names);
  const toml::array* array = node.as_array();
  if (array == nullptr || (any_count ? array->empty() : static_cast<int>(array->size()) != kind.count))
    return must_be(expected, node);
  for (const toml::node& element : *array) {
    int place = 0;
    if (Complaint complaint = find_name(kind, element, place)) return complaint;
    if (any_count && std::ranges::find(chosen, place) != chosen.end())
      return " names " + quoted(kind.names[place]) + " twice";
    chosen.push_back(place);
  }
  kind.set(record, chosen);
  return {};
}

}  // namespace

std::string described(const toml::node& node) {
  if (node.is_string()) return "the text " + quoted(node.as_string()->get());
  if (node.is_integer()) return fmt::format("{}", node.as_integer()->get());
  if (node.is_floating_point()) return fmt::format("{}", node.as_floating_point()->get());
  if (node.is_boolean()) return node.as_boolean()->get() ? "true" : "false";
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "a list of tables";
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> elements;
    for (const toml::node& element : *array) elements.push_back(described(element));
    return fmt::format("[{}]", joined(elements));
  }
  return "a date or a time";
}

template <class Record>
std::optional<std::string> read_value(const Key<Record>& key, const toml::node& node, Record& record) {
  const Complaint complaint =
      std::visit([&](const auto& kind) { return assign(kind, node, record); }, key.kind);
  if (!complaint) return {};
  return "'" + key.name + "'" + *complaint;
}

template std::optional<std::string> read_value(const Key<simulation::Case>&, const toml::node&,
                                               simulation::Case&);
template std::optional<std::string> read_value(const Key<BubbleEntry>&, const toml::node&, BubbleEntry&);

}  // namespace spume::config
