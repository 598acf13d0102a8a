#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "spume/verification/four_borders.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

/// One row of a printed table: Δt ∝ h and Δt ∝ h².
struct PrintedRow {
  int n;
  double largest, norm, largest_fine, norm_fine;
};

constexpr double printed_digits = 7e-6;  // half a digit, and one number that is off by 6e-6

void compare(Report& report, const std::string& what, const BorderError& ours, double largest, double norm,
             const std::string& source) {
  report.absolute(what + "largest", ours.largest, largest, printed_digits, source);
  report.absolute(what + "norm", ours.norm, norm, printed_digits, source);
}

double largest_difference(const std::vector<std::vector<double>>& a,
                          const std::vector<std::vector<double>>& b) {
  double largest = 0;
  for (std::size_t border = 0; border < a.size(); ++border)
    for (std::size_t i = 0; i < a[border].size(); ++i)
      largest = std::max(largest, std::abs(a[border][i] - b[border][i]));
  return largest;
}

/// Order in Δt of the positive scheme on one mesh.
void order_in_time(Report& report, int n, const std::vector<int>& steps) {
  const auto converged = positive_border_end(n, 16 * steps.back());
  double coarser = 0;
  for (const int count : steps) {
    const double error = largest_difference(positive_border_end(n, count), converged);
    const std::string what = fmt::format("positive scheme, n = {}, {} steps: ", n, count);
    report.told(what + "error in time alone", error, "the same mesh, many steps", 0.0);
    if (coarser > 0)
      report.absolute(what + "order in time", std::log2(coarser / error), 2, 0.1, "second order");
    coarser = error;
  }
}

/// Largest change of the liquid, relative, over 1024 steps without source.
double ledger_error(const BorderHistory& history) {
  const auto liquid = border_liquid(history);
  double largest = 0;
  for (double v : liquid) largest = std::max(largest, std::abs(v / liquid.front() - 1));
  return largest;
}

}  // namespace

void border_table3(const parallel::Communicator&, Scale scale, Report& report) {
  report.note(
      "four borders that meet at two junctions, λ given; errors over 0 ≤ t ≤ 1 before the projection");
  std::vector<PrintedRow> rows{{32, .06374, .05624, .06374, .05624},
                               {64, .03212, .02846, .01597, .01415},
                               {128, .01612, .01433, .00400, .00354},
                               {256, .00808, .00720, .00100, .00089},
                               {512, .00404, .00361, .00025, .00022}};
  if (scale == Scale::Small) rows.resize(3);
  for (const auto& row : rows) {
    compare(report, fmt::format("paper's scheme, n = {}, Δt = 1/n: ", row.n),
            published_border_error(row.n, row.n), row.largest, row.norm, "Table 3");
    compare(report, fmt::format("paper's scheme, n = {}, Δt = 32/n²: ", row.n),
            published_border_error(row.n, row.n * row.n / 32), row.largest_fine, row.norm_fine, "Table 3");
  }
  BorderError coarser;
  for (const auto& row : rows) {
    const BorderError error = positive_border_error(row.n, row.n);
    const std::string what = fmt::format("positive scheme, n = {}, Δt = 1/n: ", row.n);
    if (row.n == 64)
      report.at_most(what + "largest", error.largest, 0.0013, "a 25th of Table 3's");
    else
      report.told(what + "largest", error.largest, "Table 3, paper's scheme", row.largest);
    report.told(what + "norm", error.norm, "Table 3, paper's scheme", row.norm);
    if (coarser.largest > 0) {
      report.absolute(what + "order", std::log2(coarser.largest / error.largest), 2, 0.15, "second order");
      report.absolute(what + "order of the norm", std::log2(coarser.norm / error.norm), 2, 0.15,
                      "second order");
    }
    coarser = error;
  }
  order_in_time(report, 64, {8, 16, 32, 64});
}

void border_table4(const parallel::Communicator&, Scale scale, Report& report) {
  report.note("the same borders, λ = 1 at first, no source; runs of n/2 and n edges differ by");
  std::vector<PrintedRow> rows{{64, .01136, .00308, .01877, .00482},
                               {128, .00569, .00119, .00697, .00141},
                               {256, .00170, .00038, .00121, .00031},
                               {512, .00062, .00016, .00027, .00008},
                               {1024, .00028, .00008, .00007, .00002}};
  if (scale == Scale::Small) rows.resize(3);
  BorderHistory paper = published_border_history(32, 64), paper_fine = published_border_history(32, 32),
                positive = positive_border_history(32, 64);
  for (const auto& row : rows) {
    const std::string n = fmt::format("n = {}, ", row.n);
    const auto next = published_border_history(row.n, 2 * row.n);
    compare(report, "paper's scheme, " + n + "Δt = 5/n: ", border_difference(paper, next), row.largest,
            row.norm, "Table 4");
    paper = next;
    const auto next_fine = published_border_history(row.n, row.n * row.n / 32);
    compare(report, "paper's scheme, " + n + "Δt = 320/n²: ", border_difference(paper_fine, next_fine),
            row.largest_fine, row.norm_fine, "Table 4");
    paper_fine = next_fine;
    const auto next_positive = positive_border_history(row.n, 2 * row.n);
    const BorderError difference = border_difference(positive, next_positive);
    report.told("positive scheme, " + n + "Δt = 5/n: largest", difference.largest, "Table 4, paper's scheme",
                row.largest);
    report.told("positive scheme, " + n + "Δt = 5/n: norm", difference.norm, "Table 4, paper's scheme",
                row.norm);
    positive = next_positive;
  }
  report.at_most("paper's scheme, n = 64, 1024 steps: change of the liquid, relative",
                 ledger_error(published_border_history(64, 1024)), 1e-13, "conserved");
  report.at_most("positive scheme, n = 64, 1024 steps: change of the liquid, relative",
                 ledger_error(positive_border_history(64, 1024)), 1e-13, "conserved");
}

}  // namespace spume::verification
