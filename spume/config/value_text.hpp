#pragma once

#include <string>

#include "spume/config/key.hpp"

namespace spume::config {

/// The value that `record` has, as TOML; a number in the fewest digits that give it back exactly. Empty for a
/// value that is not given. Defined for the two records of the table, simulation::Case and BubbleEntry.
template <class Record>
std::string value_text(const Kind<Record>& kind, Record& record);

/// What values the key may have: "> 0", "≥ 16, three whole numbers", "\"gas\" | \"quasistatic\"".
template <class Record>
std::string range_text(const Kind<Record>& kind);

/// "> 0", "0 … 0.6"; empty when every number will do.
std::string range_text(const Range& range);

}  // namespace spume::config
