#pragma once

#include <string>

namespace spume::simulation {

/// What the run is doing right now, for the live line.
struct ProgressState {
  std::string stage;       ///< "rearrange", "drain", "rupture", "equilibrate"
  double time = 0;         ///< simulated [s]
  double dt = 0;           ///< [s]
  std::string limited_by;  ///< what limits the step
  int bubbles = 0;
  int ruptures = 0;
  double fraction = -1;  ///< of the whole run done, an estimate in [0, 1]; −1 unknown
};

/// A line on the terminal that says stage, simulated time, step and what limits it, wall time and an estimate
/// of what is left; rewritten at most five times a second. Writes nothing when `enabled` is false (output not
/// a terminal, --quiet, or not rank 0).
class ProgressLine {
 public:
  explicit ProgressLine(bool enabled);
  ~ProgressLine();  ///< ends the line
  void show(const ProgressState& state);
  /// Prints a lasting line (an event) above the live one.
  void announce(const std::string& text);

 private:
  bool enabled_;
  double started_, last_shown_ = -1;
  std::size_t width_ = 0;
};

}  // namespace spume::simulation
