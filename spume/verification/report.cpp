#include "spume/verification/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spume::verification {

namespace {

std::string error_text(const Row& row) {
  switch (row.band) {
    case Row::Band::Relative:
      return fmt::format("off by {:.3g} %, allowed {:.3g} %", 100 * row.error(), 100 * row.limit);
    case Row::Band::Absolute:
      return fmt::format("off by {:.3g}, allowed {:.3g}", row.error(), row.limit);
    case Row::Band::AtMost:
      return fmt::format("at most {:.4g}", row.limit);
    case Row::Band::AtLeast:
      return fmt::format("at least {:.4g}", row.limit);
    case Row::Band::None:
      break;
  }
  return "not judged";
}

std::string line_of(const Row& row) {
  const std::string expected = row.expected ? fmt::format("{:.7g}", *row.expected) : "-";
  const char* const verdict = row.band == Row::Band::None ? "      " : row.inside() ? "ok    " : "WRONG ";
  return fmt::format("  {}{:<44} {:>13.7g}  expected {:>12}  {}  [{}]", verdict, row.quantity, row.measured,
                     expected, error_text(row), row.source);
}

}  // namespace

double Row::error() const {
  if (!expected) return measured;
  return band == Band::Relative ? measured / *expected - 1 : measured - *expected;
}

bool Row::inside() const {
  switch (band) {
    case Band::Relative:
    case Band::Absolute:
      return std::abs(error()) <= limit;
    case Band::AtMost:
      return measured <= limit;
    case Band::AtLeast:
      return measured >= limit;
    case Band::None:
      break;
  }
  return true;
}

Report::Report(const parallel::Communicator& communicator) : is_root_(communicator.is_root()) {}

void Report::print(const std::string& line) const {
  if (!is_root_) return;
  std::puts(line.c_str());
  std::fflush(stdout);
}

void Report::begin(const std::string& name, const std::string& summary, double expected_seconds) {
  begun_ = std::chrono::steady_clock::now();
  first_row_ = rows_.size();
  failed_before_ = n_failed_;
  print(fmt::format("{}: {} (about {:.0f} s)", name, summary, expected_seconds));
}

void Report::end() {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begun_;
  const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(first_row_);
  const auto n_wrong = std::count_if(first, rows_.end(), [](const Row& row) { return !row.inside(); }) +
                       n_failed_ - failed_before_;
  print(fmt::format("  {} in {:.1f} s\n",
                    n_wrong == 0 ? "within all bands" : fmt::format("{} outside their bands", n_wrong),
                    wall.count()));
}

void Report::add(Row row) {
  print(line_of(row));
  rows_.push_back(std::move(row));
}

void Report::relative(const std::string& quantity, double measured, double expected, double limit,
                      const std::string& source) {
  add({quantity, measured, expected, Row::Band::Relative, limit, source});
}

void Report::absolute(const std::string& quantity, double measured, double expected, double limit,
                      const std::string& source) {
  add({quantity, measured, expected, Row::Band::Absolute, limit, source});
}

void Report::at_most(const std::string& quantity, double measured, double limit, const std::string& source) {
  add({quantity, measured, {}, Row::Band::AtMost, limit, source});
}

void Report::at_least(const std::string& quantity, double measured, double limit, const std::string& source) {
  add({quantity, measured, {}, Row::Band::AtLeast, limit, source});
}

void Report::told(const std::string& quantity, double measured, const std::string& source,
                  std::optional<double> expected) {
  add({quantity, measured, expected, Row::Band::None, 0, source});
}

void Report::note(const std::string& text) {
  print("  " + text);
}

void Report::failed(const std::string& why) {
  ++n_failed_;
  print("  WRONG " + why);
}

int Report::n_judged() const {
  return n_failed_ + static_cast<int>(std::count_if(rows_.begin(), rows_.end(), [](const Row& row) {
           return row.band != Row::Band::None;
         }));
}

int Report::n_outside() const {
  return n_failed_ + static_cast<int>(std::count_if(rows_.begin(), rows_.end(),
                                                    [](const Row& row) { return !row.inside(); }));
}

}  // namespace spume::verification
