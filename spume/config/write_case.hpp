#pragma once

#include <string>

#include "spume/simulation/case.hpp"

namespace spume::config {

/// The case as TOML with every key, defaults too, and the version of the program in a comment; parse_case
/// gives the same case again, number for number.
std::string write_case(const simulation::Case& run_case);

}  // namespace spume::config
