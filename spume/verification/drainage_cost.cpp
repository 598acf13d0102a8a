// Processor time against error of the paper's drainage schemes and of the positive one, where both run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"
#include "spume/base/stage_times.hpp"
#include "spume/drainage/drain.hpp"
#include "spume/verification/catenoid.hpp"
#include "spume/verification/drainage_runs.hpp"
#include "spume/verification/four_borders.hpp"
#include "spume/verification/four_bubble_films.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

/// A run with n edges or sections and so many steps.
struct Cost {
  int n, steps;
  double error, seconds;
};

/// Runs a scheme with n edges and so many steps.
using Scheme = std::function<Cost(int n, int steps)>;

/// Those runs that are more accurate than every quicker one, the quickest first: what the scheme costs at an
/// error if mesh and step are chosen best.
std::vector<Cost> best_of(std::vector<Cost> runs) {
  std::ranges::sort(runs, {}, &Cost::seconds);
  std::vector<Cost> best;
  for (const Cost& run : runs)
    if (best.empty() || run.error < best.back().error) best.push_back(run);
  return best;
}

/// Time at an error, by powers between the best runs; none outside of their errors.
std::optional<double> time_at(const std::vector<Cost>& best, double error) {
  for (std::size_t i = 0; i + 1 < best.size(); ++i) {
    const Cost &rough = best[i], &fine = best[i + 1];
    if (error > rough.error || error < fine.error) continue;
    const double part = std::log(rough.error / error) / std::log(rough.error / fine.error);
    return rough.seconds * std::pow(fine.seconds / rough.seconds, part);
  }
  return std::nullopt;
}

/// The power of 1/error with which the time grows, over the more accurate half (in the logarithm) of the best
/// runs, of which there must be two.
double growth(const std::vector<Cost>& best) {
  expects(best.size() >= 2, "a power needs two runs");
  const Cost& last = best.back();
  const double middle = std::sqrt(best.front().error * last.error);
  const auto rough = std::ranges::partition_point(best, [&](const Cost& run) { return run.error >= middle; });
  const Cost& from = *std::prev(rough);
  return std::log(last.seconds / from.seconds) / std::log(from.error / last.error);
}

/// The best of all runs of n and steps = first(n), doubled `doublings` times. Steps that are too long for a
/// scheme to stay positive are left out.
std::vector<Cost> scan(const Scheme& scheme, const std::vector<int>& sizes,
                       const std::function<int(int)>& first, int doublings) {
  std::vector<Cost> runs;
  for (int n : sizes)
    for (int d = 0; d <= doublings; ++d) try {
        runs.push_back(scheme(n, first(n) << d));
      } catch (const NumericalError&) {
      }
  return best_of(runs);
}

void tell_runs(Report& report, const std::string& what, const std::vector<Cost>& best) {
  for (const auto& [n, steps, error, seconds] : best)
    report.note(
        fmt::format("{}, n = {}, {} steps: error {:.3g}, {:.3g} ms", what, n, steps, error, 1e3 * seconds));
  report.told(what + ": power of 1/error with which the time grows", growth(best), "this scan");
}

/// Times of a scheme over those of the positive one at equal errors, a factor of two apart. The last of them,
/// at the least error, is 50 at least where that is `wanted`.
void compare(Report& report, const std::string& what, const std::vector<Cost>& published,
             const std::vector<Cost>& positive, bool wanted) {
  tell_runs(report, what, published);
  std::vector<std::pair<double, double>> ratios;  // error, ratio
  for (double error = 0.25; error > 1e-7; error *= 0.5) {
    const auto theirs = time_at(published, error), ours = time_at(positive, error);
    if (theirs && ours) ratios.emplace_back(error, *theirs / *ours);
  }
  expects(!ratios.empty(), "the schemes have errors in common");
  for (const auto& [error, ratio] : ratios) {
    const std::string row = fmt::format("{}: time over ours at an error of {:.2g}", what, error);
    if (wanted && error == ratios.back().first)
      report.at_least(row, ratio, 50, "a fiftieth of the paper's time");
    else
      report.told(row, ratio, "this scan");
  }
}

/// Runs three times, the quickest counted: whatever else the machine does disturbs short ones.
Cost border_cost(BorderError run(int n, int steps), int n, int steps) {
  BorderError error = run(n, steps);
  for (int again = 0; again < 2; ++again) error.seconds = std::min(error.seconds, run(n, steps).seconds);
  return {n, steps, error.largest, error.seconds};
}

Cost lamella_cost(bool positive, int n, int steps) {
  const Catenoid mesh = catenoid(n);
  const auto materials = catenoid_materials({0, 0, 1});
  const LamellaRun run =
      positive ? positive_lamella_run(mesh, materials, SourceRule::Interpolated)
               : published_lamella_run(mesh, catenoid_surface(mesh, materials.gravity), materials, true);
  const LamellaError error = lamella_error(mesh, run, std::numbers::pi, steps);
  return {n, steps, error.largest, error.seconds};
}

/// The foam of Fig. 15, on which the published scheme runs a little while: what it takes a second of the foam
/// until then, over what the positive scheme takes to the end.
void compare_foam(Report& report, bool small) {
  constexpr double end = 16.1;
  const auto nothing_counts = [](const state::FilmNetwork&) { return state::ThinPoint{}; };
  for (const double spacing : small ? std::vector{0.2e-3} : std::vector{0.13e-3, 0.065e-3}) {
    const auto network = four_bubble_network(four_bubble_films(1e-3, spacing), 1e-3);
    const std::string what = fmt::format("foam of Fig. 15, edges of {:.3g} mm: ", 1e3 * spacing);
    auto drained = network;
    double begun = processor_time();
    const auto outcome = drainage::drain(drained, fig15_materials(), {.max_time = end, .tolerance = 0.02}, 0,
                                         nothing_counts, {});
    const double seconds = processor_time() - begun;
    report.told(what + "positive scheme, steps to 16.1 s", outcome.n_steps, "this mesh");
    report.told(what + "positive scheme, processor time to 16.1 s [s]", seconds, "this mesh");

    drained = network;
    double elapsed = 0, n_steps = 0, published_seconds = 0;
    begun = processor_time();
    const auto on_step = [&](const drainage::DrainageProgress& progress, const state::FilmNetwork&) {
      elapsed = progress.elapsed;
      n_steps = progress.n_steps;
      published_seconds = processor_time() - begun;
      return true;
    };
    try {
      drainage::drain(drained, fig15_materials(), {.scheme = drainage::Scheme::Paper, .max_time = end}, 0,
                      nothing_counts, on_step);
    } catch (const NumericalError&) {
      report.told(what + "paper's scheme is not positive after [s]", elapsed, "this mesh");
    }
    report.told(what + "paper's scheme, steps until then", n_steps, "this mesh");
    report.told(what + "time of the paper's scheme over ours, for 16.1 s at the same pace",
                published_seconds * end / elapsed / seconds, "bar: 50");
  }
}

}  // namespace

void drainage_cost(const parallel::Communicator&, Scale scale, Report& report) {
  const bool small = scale == Scale::Small;
  report.note("processor time of the steps, without sources and set-up, of those runs that are the");
  report.note("most accurate for their time among many of n and Δt; largest error over all nodes and times");
  const auto sizes = [small](std::vector<int> all, std::size_t n_small) {
    if (small) all.resize(n_small);
    return all;
  };
  const auto n_edges = [](int n) { return n; };
  const Scheme paper_borders = [](int n, int steps) { return border_cost(published_border_error, n, steps); };
  const Scheme our_borders = [](int n, int steps) { return border_cost(positive_border_error, n, steps); };
  const auto borders = scan(
      our_borders, sizes({8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256}, 5), [](int n) { return n / 8; }, 3);
  tell_runs(report, "four borders, positive scheme", borders);
  compare(report, "four borders, paper's scheme, Δt = 1/n",
          scan(paper_borders, sizes({32, 64, 128, 256, 512, 1024, 2048}, 3), n_edges, 0), borders, !small);
  compare(report, "four borders, paper's scheme, best n and Δt",
          scan(
              paper_borders, sizes({8, 16, 32, 64, 128, 256}, 3), [](int n) { return n * n / 8; }, 3),
          borders, false);

  const Scheme paper_catenoid = [](int n, int steps) { return lamella_cost(false, n, steps); };
  const Scheme our_catenoid = [](int n, int steps) { return lamella_cost(true, n, steps); };
  const auto films = scan(
      our_catenoid, sizes({8, 12, 16, 24, 32, 48, 64}, 3), [](int n) { return n / 4; }, 2);
  tell_runs(report, "catenoid, positive scheme", films);
  compare(report, "catenoid, paper's scheme, Δt = π/4n",
          scan(
              paper_catenoid, sizes({8, 16, 32, 64}, 2), [](int n) { return 4 * n; }, 0),
          films, !small);
  compare(report, "catenoid, paper's scheme, best n and Δt",
          scan(
              paper_catenoid, sizes({8, 12, 16, 24, 32, 48}, 2), [](int n) { return n * n / 4; }, 3),
          films, false);
  compare_foam(report, small);
}

}  // namespace spume::verification
