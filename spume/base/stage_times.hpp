#pragma once

#include <ctime>
#include <string_view>
#include <utility>
#include <vector>

namespace spume {

/// Processor time of this rank [s]. Unlike wall time it does not count other programs on a shared machine.
inline double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Processor time of the stages of a computation, added up over its calls. A stage ends where lap() names it
/// and began where the one before it ended, or at restart().
class StageTimes {
 public:
  void restart() { last_ = processor_time(); }
  /// `stage` must be a string literal or live as long as this object.
  void lap(std::string_view stage) {
    const double now = processor_time();
    add(stage, now - last_);
    last_ = now;
  }
  void add(std::string_view stage, double seconds) {
    for (auto& [name, sum] : seconds_)
      if (name == stage) {
        sum += seconds;
        return;
      }
    seconds_.emplace_back(stage, seconds);
  }
  /// Stage and seconds, in the order in which the stages were first met.
  const std::vector<std::pair<std::string_view, double>>& seconds() const { return seconds_; }

 private:
  double last_ = processor_time();
  std::vector<std::pair<std::string_view, double>> seconds_;
};

}  // namespace spume
