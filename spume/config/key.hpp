#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "spume/base/index3.hpp"
#include "spume/base/vec3.hpp"

namespace spume::config {

/// What a number may be; always finite.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_excluded = false;

  bool contains(double x) const { return (lowest_excluded ? x > lowest : x >= lowest) && x <= highest; }
};
constexpr Range any_number() {
  return {};
}
constexpr Range positive() {
  return {.lowest = 0, .lowest_excluded = true};
}
constexpr Range non_negative() {
  return {.lowest = 0};
}
constexpr Range positive_up_to(double highest) {
  return {.lowest = 0, .highest = highest, .lowest_excluded = true};
}
constexpr Range at_least(double lowest) {
  return {.lowest = lowest};
}

// The kinds of values that a key can have. Each knows the member of the record (a Case, or one bubble of its
// list) that the key sets; the member is a function because members of parts that may be absent are made on
// first use.
template <class Record, class Value>
using Member = Value& (*)(Record&);

template <class Record>
struct Text {
  Member<Record, std::string> member;
};
template <class Record>
struct Flag {
  Member<Record, bool> member;
};
template <class Record>
struct Number {
  Member<Record, double> member;
  Range range = positive();
};
template <class Record>
struct WholeNumber {
  Member<Record, int> member;
  int lowest = 0;
};
template <class Record>
struct Seed {
  Member<Record, std::uint64_t> member;
};
template <class Record>
struct Vector {
  Member<Record, Vec3> member;
  Range range = any_number();  ///< of each component
};
template <class Record>
struct OptionalVector {
  Member<Record, std::optional<Vec3>> member;
};
template <class Record>
struct Counts {
  Member<Record, Index3> member;
  int lowest = 0;
};
/// Pairs of phases [[a, b], …].
template <class Record>
struct PhasePairs {
  Member<Record, std::vector<std::array<int, 2>>> member;
};
/// One or several of a list of names, seen from outside as places in that list.
template <class Record>
struct Choice {
  static constexpr int any_count = 0;  ///< a list of one or more different names

  std::vector<std::string> names;
  std::function<std::vector<int>(Record&)> get;
  std::function<void(Record&, const std::vector<int>&)> set;
  int count = 1;  ///< 1: a single name; n > 1: an array of n; any_count
};

template <class Record>
using Kind =
    std::variant<Text<Record>, Flag<Record>, Number<Record>, WholeNumber<Record>, Seed<Record>,
                 Vector<Record>, OptionalVector<Record>, Counts<Record>, PhasePairs<Record>, Choice<Record>>;

/// A key of the case file: where its value goes and what it means.
template <class Record>
struct Key {
  std::string name;    ///< with its section: "gas.density"
  Kind<Record> kind;   ///< member, type, range
  std::string unit;    ///< SI; empty for none
  std::string symbol;  ///< of the paper; empty for none
  std::string meaning;
  bool required = false;
};

/// "density" of "gas.density".
inline std::string leaf_of(const std::string& name) {
  return name.substr(name.rfind('.') + 1);
}
/// "gas" of "gas.density"; empty at the top level.
inline std::string section_of(const std::string& name) {
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? std::string{} : name.substr(0, dot);
}

}  // namespace spume::config
