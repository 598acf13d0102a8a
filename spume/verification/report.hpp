#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "spume/parallel/communicator.hpp"

namespace spume::verification {

/// One measured value beside what it should be.
struct Row {
  std::string quantity;
  double measured;
  std::optional<double> expected;  ///< exact or published; none where only a limit is set or nothing is known
  /// How far `measured` may be from `expected`, or how large it may be; none: told, not judged.
  enum class Band { None, Relative, Absolute, AtMost, AtLeast } band;
  double limit;
  std::string source;  ///< of the expected value or of the limit

  double error() const;  ///< relative or absolute, as the band says
  bool inside() const;   ///< false where `measured` is not a number
};

/// Collects the rows of studies and prints each as it comes, on rank 0.
class Report {
 public:
  explicit Report(const parallel::Communicator& communicator);

  void begin(const std::string& name, const std::string& summary, double expected_seconds);
  /// |measured / expected − 1| ≤ limit.
  void relative(const std::string& quantity, double measured, double expected, double limit,
                const std::string& source);
  /// |measured − expected| ≤ limit.
  void absolute(const std::string& quantity, double measured, double expected, double limit,
                const std::string& source);
  void at_most(const std::string& quantity, double measured, double limit, const std::string& source);
  void at_least(const std::string& quantity, double measured, double limit, const std::string& source);
  /// A value without a band, with what it compares to where that is known.
  void told(const std::string& quantity, double measured, const std::string& source,
            std::optional<double> expected = {});
  /// A line of text: the set-up of what follows.
  void note(const std::string& text);
  /// A study could not be finished; counts as a value outside its band.
  void failed(const std::string& why);
  void end();

  const std::vector<Row>& rows() const { return rows_; }
  int n_judged() const;
  int n_outside() const;

 private:
  void add(Row row);
  void print(const std::string& line) const;

  bool is_root_;
  std::vector<Row> rows_;
  int n_failed_ = 0;
  std::size_t first_row_ = 0;  ///< of the present study
  int failed_before_ = 0;
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace spume::verification
