#pragma once

#include <string>

namespace spume::config {

/// Version of the program, "0.1.0".
std::string version();

}  // namespace spume::config
