#include "spume/config/value_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "spume/config/keys.hpp"
#include "spume/config/text.hpp"

namespace spume::config {

namespace {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

std::string vector_text(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

std::string joined_with(const std::string& text, const std::string& other) {
  return text.empty() ? other : text + ", " + other;
}

template <class Record>
std::string choice_text(const Choice<Record>& choice, const std::vector<int>& chosen) {
  std::vector<std::string> names;
  for (const int place : chosen) names.push_back(quoted(choice.names[place]));
  return choice.count == 1 ? names.front() : fmt::format("[{}]", joined(names));
}

template <class Record>
std::string choice_range(const Choice<Record>& choice) {
  std::vector<std::string> names;
  for (const auto& name : choice.names) names.push_back(quoted(name));
  const std::string one = joined(names, " | ");
  if (choice.count == 1) return one;
  return choice.count == Choice<Record>::any_count ? "list of " + one
                                                   : fmt::format("{} of {}", choice.count, one);
}

}  // namespace

std::string range_text(const Range& range) {
  const bool bounded_below = std::isfinite(range.lowest), bounded_above = std::isfinite(range.highest);
  if (!bounded_below && !bounded_above) return {};
  if (!bounded_above) return fmt::format("{} {}", range.lowest_excluded ? ">" : "≥", range.lowest);
  if (range.lowest_excluded) return fmt::format("> {}, ≤ {}", range.lowest, range.highest);
  return fmt::format("{} … {}", range.lowest, range.highest);
}

template <class Record>
std::string value_text(const Kind<Record>& kind, Record& record) {
  return std::visit(
      Overloaded{
          [&](const Text<Record>& k) { return quoted(k.member(record)); },
          [&](const Flag<Record>& k) { return std::string(k.member(record) ? "true" : "false"); },
          [&](const Number<Record>& k) { return fmt::format("{}", k.member(record)); },
          [&](const WholeNumber<Record>& k) { return fmt::format("{}", k.member(record)); },
          [&](const Seed<Record>& k) { return fmt::format("{}", k.member(record)); },
          [&](const Vector<Record>& k) { return vector_text(k.member(record)); },
          [&](const OptionalVector<Record>& k) {
            return k.member(record) ? vector_text(*k.member(record)) : std::string{};
          },
          [&](const Counts<Record>& k) {
            const Index3& n = k.member(record);
            return fmt::format("[{}, {}, {}]", n.i, n.j, n.k);
          },
          [&](const PhasePairs<Record>& k) {
            std::vector<std::string> pairs;
            for (const auto& [a, b] : k.member(record)) pairs.push_back(fmt::format("[{}, {}]", a, b));
            return fmt::format("[{}]", joined(pairs));
          },
          [&](const Choice<Record>& k) { return choice_text(k, k.get(record)); },
      },
      kind);
}

template <class Record>
std::string range_text(const Kind<Record>& kind) {
  return std::visit(Overloaded{
                        [](const Text<Record>&) { return std::string("text"); },
                        [](const Flag<Record>&) { return std::string("true | false"); },
                        [](const Number<Record>& k) { return range_text(k.range); },
                        [](const WholeNumber<Record>& k) { return fmt::format("whole, ≥ {}", k.lowest); },
                        [](const Seed<Record>&) { return std::string("whole, ≥ 0"); },
                        [](const Vector<Record>& k) { return joined_with(range_text(k.range), "3 numbers"); },
                        [](const OptionalVector<Record>&) { return std::string("3 numbers"); },
                        [](const Counts<Record>& k) { return fmt::format("3 whole, ≥ {}", k.lowest); },
                        [](const PhasePairs<Record>&) { return std::string("[[a, b], …]"); },
                        [](const Choice<Record>& k) { return choice_range(k); },
                    },
                    kind);
}

template std::string value_text(const Kind<simulation::Case>&, simulation::Case&);
template std::string value_text(const Kind<BubbleEntry>&, BubbleEntry&);
template std::string range_text(const Kind<simulation::Case>&);
template std::string range_text(const Kind<BubbleEntry>&);

}  // namespace spume::config
