#pragma once

#include <source_location>

namespace spume {

[[noreturn]] void contract_violation(const char* what, const std::source_location& where);

/// States what a function needs from its caller; a violation is a bug of ours and throws std::logic_error.
inline void expects(bool condition, const char* what,
                    const std::source_location& where = std::source_location::current()) {
  if (!condition) contract_violation(what, where);
}

}  // namespace spume
