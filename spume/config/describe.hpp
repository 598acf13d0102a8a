#pragma once

#include <string>

namespace spume::config {

/// Every key of the case file with meaning, unit, default, range and symbol, as tables: all sections, or the
/// one named
/// ("drainage", "foam.bubble"). Throws InputError with the nearest name when there is no such section.
std::string describe(const std::string& section = {});

}  // namespace spume::config
