#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "spume/drainage/level_set_geometry.hpp"
#include "spume/verification/catenoid.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

const Vec3 up{0, 0, 1}, sideways{0, 1, 0};

/// Prints both norms of an error beside another's.
void tell(Report& report, const std::string& what, const LamellaError& error, const std::string& source,
          double largest, double norm) {
  report.told(what + "largest", error.largest, source, largest);
  report.told(what + "norm", error.norm, source, norm);
}

/// Judges the order of both norms when n doubles; nothing the first time.
void judge_order(Report& report, const std::string& what, const LamellaError& coarser,
                 const LamellaError& error, double order, double limit) {
  if (coarser.largest == 0) return;
  const std::string source = order == 1 ? "first order" : "second order";
  report.absolute(what + "order", std::log2(coarser.largest / error.largest), order, limit, source);
  report.absolute(what + "order of the norm", std::log2(coarser.norm / error.norm), order, limit, source);
}

LamellaError published_error(int n, int steps) {
  const Catenoid mesh = catenoid(n);
  const auto materials = catenoid_materials(up);
  const auto run = published_lamella_run(mesh, catenoid_surface(mesh, materials.gravity), materials, true);
  return lamella_error(mesh, run, std::numbers::pi, steps);
}

LamellaError positive_error(int n, int steps, CatenoidMesh kind, SourceRule rule) {
  const Catenoid mesh = catenoid(n, kind);
  const auto run = positive_lamella_run(mesh, catenoid_materials(up), rule);
  return lamella_error(mesh, run, std::numbers::pi, steps);
}

struct PrintedRow {
  int n;
  double largest, norm;
};

/// The paper's scheme with Δt ∝ h^order against Table 1.
void published_table1(Report& report, const std::vector<PrintedRow>& rows, int order) {
  LamellaError coarser;
  for (const auto& row : rows) {
    const auto error = published_error(row.n, order == 1 ? 4 * row.n : row.n * row.n / 2);
    const std::string what =
        fmt::format("paper's scheme, n = {}, Δt = {}: ", row.n, order == 1 ? "π/4n" : "2π/n²");
    if (row.n < 16) {
      tell(report, what, error, "Table 1", row.largest, row.norm);
    } else {
      report.relative(what + "largest", error.largest, row.largest, 0.06, "Table 1");
      report.relative(what + "norm", error.norm, row.norm, 0.06, "Table 1");
      judge_order(report, what, coarser, error, order, order == 1 ? 0.15 : 0.2);
    }
    coarser = row.n < 16 ? LamellaError{} : error;
  }
}

/// k and g_s by differences of a signed distance on a grid: their own order, and Table 1 with them.
void level_set_rows(Report& report, int most) {
  const auto materials = catenoid_materials(up);
  const auto exact = catenoid_surface(catenoid(16), materials.gravity);
  double coarse_k = 0, coarse_g = 0;
  for (const double h : {0.1, 0.05, 0.025}) {
    const auto found =
        drainage::geometry_of_level_set(catenoid_distance, h, materials.gravity, exact.position);
    double error_k = 0, error_g = 0;
    for (std::size_t i = 0; i < exact.position.size(); ++i) {
      error_k = std::max(error_k, std::abs(found.curvature_squared[i] - exact.curvature_squared[i]));
      error_g = std::max(error_g, norm(found.tangential_gravity[i] - exact.tangential_gravity[i]));
    }
    const std::string what = fmt::format("level set, spacing {}: ", h);
    report.told(what + "largest error of k", error_k, "2 sech⁴ v", 0.0);
    report.told(what + "largest error of g_s", error_g, "exact normal", 0.0);
    if (coarse_k > 0) {
      report.absolute(what + "order of k", std::log2(coarse_k / error_k), 2, 0.15, "second order");
      report.absolute(what + "order of g_s", std::log2(coarse_g / error_g), 2, 0.3, "second order");
    }
    coarse_k = error_k;
    coarse_g = error_g;
  }
  for (const auto& [n, largest, norm] :
       std::vector<PrintedRow>{{8, .15422, .27302}, {16, .06780, .11975}, {32, .03631, .06287}}) {
    if (n > most) break;
    const Catenoid mesh = catenoid(n);
    auto surface = catenoid_surface(mesh, materials.gravity);
    auto found =
        drainage::geometry_of_level_set(catenoid_distance, 2.5 / n, materials.gravity, surface.position);
    surface.curvature_squared = found.curvature_squared;
    surface.tangential_gravity = found.tangential_gravity;
    const auto run = published_lamella_run(mesh, std::move(surface), materials, true);
    tell(report,
         fmt::format("paper's scheme with k, g_s by level set of spacing 2.5/n, n = {}, Δt = π/4n: ", n),
         lamella_error(mesh, run, std::numbers::pi, 4 * n), "Table 1", largest, norm);
  }
}

/// The positive scheme with the source integrated, on a regular and an uneven mesh, and interpolated.
void positive_rows(Report& report, int most) {
  LamellaError coarser, coarser_uneven;
  for (int n = 8; n <= most; n *= 2) {
    const auto error = positive_error(n, 2 * n, CatenoidMesh::Regular, SourceRule::Integrated);
    const std::string what = fmt::format("positive scheme, n = {}, Δt = π/2n: ", n);
    if (n == 64) {
      report.at_most(what + "largest", error.largest, 0.0013, "a 15th of Table 1's");
      report.at_most(what + "norm", error.norm, 0.0024, "a 14th of Table 1's");
    } else {
      tell(report, what, error, "closed form", 0, 0);
    }
    judge_order(report, what, coarser, error, 2, 0.2);
    coarser = error;
    tell(report, what + "source interpolated: ",
         positive_error(n, 2 * n, CatenoidMesh::Regular, SourceRule::Interpolated), "closed form", 0, 0);
    if (n > 32) continue;
    const auto uneven = positive_error(n, 2 * n, CatenoidMesh::Uneven, SourceRule::Integrated);
    tell(report, what + "uneven mesh: ", uneven, "closed form", 0, 0);
    if (n > 8)
      report.absolute(what + "uneven mesh: order of the norm", std::log2(coarser_uneven.norm / uneven.norm),
                      2, 0.2, "second order");
    coarser_uneven = uneven;
  }
}

void order_in_time(Report& report) {
  const Catenoid mesh = catenoid(16);
  const auto run = positive_lamella_run(mesh, catenoid_materials(up), SourceRule::Integrated);
  const auto converged = lamella_end(mesh, run, 2, 640);
  double coarser = 0;
  for (const int steps : {10, 20, 40}) {
    const auto eta = lamella_end(mesh, run, 2, steps);
    double error = 0;
    for (std::size_t d = 0; d < eta.size(); ++d) error = std::max(error, std::abs(eta[d] - converged[d]));
    const std::string what = fmt::format("positive scheme, n = 16, {} steps to t = 2: ", steps);
    report.told(what + "error in time alone", error, "the same mesh, 640 steps", 0.0);
    if (coarser > 0)
      report.absolute(what + "order in time", std::log2(coarser / error), 2, 0.15, "second order");
    coarser = error;
  }
}

double ledger_error(const Catenoid& mesh, const LamellaHistory& history) {
  const auto liquid = lamella_liquid(mesh, history);
  double largest = 0;
  for (double v : liquid) largest = std::max(largest, std::abs(v / liquid.front() - 1));
  return largest;
}

}  // namespace

void lamella_table1(const parallel::Communicator&, Scale scale, Report& report) {
  report.note("catenoid with exact k, g_s and a given η; errors over 0 ≤ t ≤ π");
  std::vector<PrintedRow> rows{{8, .15422, .27302},
                               {16, .06780, .11975},
                               {32, .03631, .06287},
                               {64, .01952, .03263},
                               {128, .01013, .01663}};
  std::vector<PrintedRow> fine_rows{
      {8, .15422, .27302}, {16, .04255, .07190}, {32, .01139, .01895}, {64, .00284, .00482}};
  const bool small = scale == Scale::Small;
  if (small) {
    rows.resize(3);
    fine_rows.resize(3);
  }
  published_table1(report, rows, 1);
  published_table1(report, fine_rows, 2);
  level_set_rows(report, small ? 16 : 32);
  positive_rows(report, small ? 32 : 64);
  order_in_time(report);
}

void lamella_table2(const parallel::Communicator&, Scale scale, Report& report) {
  report.note(
      "catenoid with exact k, g_s across its axis, η = 1 at first; runs of n/2 and n sections differ by");
  std::vector<PrintedRow> rows{{16, .06782, .07931}, {32, .01344, .02018}, {64, .00434, .00665}};
  if (scale == Scale::Small) rows.resize(2);
  const auto materials = catenoid_materials(sideways);
  const auto published = [&](const Catenoid& mesh, int n) {
    const auto run = published_lamella_run(mesh, catenoid_surface(mesh, materials.gravity), materials, false);
    return lamella_history(mesh, run, n * n / 2);
  };
  const auto positive = [&](const Catenoid& mesh, int steps) {
    return lamella_history(mesh, positive_lamella_run(mesh, materials, {}), steps);
  };
  Catenoid mesh = catenoid(8);
  LamellaHistory paper = published(mesh, 8), ours = positive(mesh, 16);
  LamellaError coarser_paper, coarser_ours;
  for (const auto& [n, largest, norm] : rows) {
    const Catenoid finer = catenoid(n);
    const auto next_paper = published(finer, n), next_ours = positive(finer, 2 * n);
    const auto difference = lamella_difference(mesh, paper, n / 2, next_paper),
               difference_ours = lamella_difference(mesh, ours, n / 2, next_ours);
    const std::string what = fmt::format("paper's scheme, n = {}, Δt = 4/n²: ", n);
    report.at_most(what + "largest", difference.largest, largest, "Table 2, k by level set");
    report.at_most(what + "norm", difference.norm, norm, "Table 2, k by level set");
    judge_order(report, what, coarser_paper, difference, 2, 0.2);
    const std::string what_ours = fmt::format("positive scheme, n = {}, Δt = 1/n: ", n);
    tell(report, what_ours, difference_ours, "Table 2, paper's scheme", largest, norm);
    judge_order(report, what_ours, coarser_ours, difference_ours, 2, n == 32 ? 0.4 : 0.15);
    if (n == rows.back().n)
      report.at_most(
          fmt::format("paper's scheme, n = {}, {} steps: change of the liquid, relative", n, n * n / 2),
          ledger_error(finer, next_paper), 1e-13 * std::max(1.0, n * n / 2e3), "conserved");
    mesh = finer;
    paper = next_paper;
    ours = next_ours;
    coarser_paper = difference;
    coarser_ours = difference_ours;
  }
  const Catenoid small = catenoid(12);
  report.at_most("positive scheme, n = 12, 1000 steps: change of the liquid, relative",
                 ledger_error(small, positive(small, 1000)), 1e-13, "conserved");
}

}  // namespace spume::verification
