#pragma once

#include <stdexcept>

namespace spume {

/// The user asked for something that cannot be: bad case file, unreadable path, geometry outside the box.
/// The message says what was wrong, where, and what would be right. The program ends with exit code 1.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A computation left the numbers that make sense: not finite, no convergence, a step rejected for ever.
/// The program keeps the last good state and ends with exit code 2.
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The user or the system asked the run to stop; the state was saved. Exit code 3.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace spume
