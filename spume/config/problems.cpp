#include "spume/config/problems.hpp"

#include <algorithm>
#include <tuple>

#include "spume/base/error.hpp"

namespace spume::config {

std::string Place::text() const {
  if (line == 0) return source;
  return source + ":" + std::to_string(line) + ":" + std::to_string(column);
}

void Problems::throw_if_any() const {
  if (list_.empty()) return;
  std::vector<Problem> ordered = list_;
  std::ranges::stable_sort(ordered, {},
                           [](const Problem& p) { return std::tuple(p.place.line, p.place.column); });
  std::string report;
  for (const Problem& problem : ordered) {
    if (!report.empty()) report += '\n';
    report += problem.place.text() + ": " + problem.what;
  }
  throw InputError(report);
}

}  // namespace spume::config
