#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "spume/config/key.hpp"

namespace spume::config {

/// Gives the member of `record` that `key` names the value of `node`. Where the type or the range is wrong,
/// leaves the record as it was and says what is wrong: "'gas.density' must be a number > 0, not \"air\"".
/// Whole numbers do as numbers. Defined for simulation::Case and BubbleEntry.
template <class Record>
std::optional<std::string> read_value(const Key<Record>& key, const toml::node& node, Record& record);

/// What a node is, in words: "the text \"air\"", "the number -3", "a table".
std::string described(const toml::node& node);

}  // namespace spume::config
