// Processor time against error of the paper's drainage schemes and of the positive one, where both run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "spume/base/error.hpp"
#include "spume/verification/catenoid.hpp"
#include "spume/verification/four_borders.hpp"
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
/// runs.
double growth(const std::vector<Cost>& best) {
  const Cost& last = best.back();
  const double middle = std::sqrt(best.front().error * last.error);
  const Cost& from = *std::ranges::find_if(best, [&](const Cost& run) { return run.error <= middle; });
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

/// Times of the two schemes at equal errors, a factor of two apart.
void compare(Report& report, const std::string& problem, const std::vector<Cost>& published,
             const std::vector<Cost>& positive) {
  tell_runs(report, problem + ", paper's scheme", published);
  tell_runs(report, problem + ", positive scheme", positive);
  double last = 0;
  for (double error = 0.25; error > 1e-7; error *= 0.5) {
    const auto theirs = time_at(published, error), ours = time_at(positive, error);
    if (!theirs || !ours) continue;
    last = *theirs / *ours;
    report.told(fmt::format("{}: time of the paper's scheme over ours at an error of {:.2g}", problem, error),
                last, "bar: 50");
  }
}

Cost border_cost(BorderError run(int n, int steps), int n, int steps) {
  const BorderError error = run(n, steps);
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

}  // namespace

void drainage_cost(const parallel::Communicator&, Scale scale, Report& report) {
  const bool small = scale == Scale::Small;
  report.note("processor time of the steps, without sources and set-up, of those runs that are the");
  report.note("most accurate for their time among many of n and Δt; largest error over all nodes and times");
  const auto published_borders = [](int n, int steps) { return border_cost(published_border_error, n, steps); };
  const auto positive_borders = [](int n, int steps) { return border_cost(positive_border_error, n, steps); };
  compare(report, "four borders",
          scan(published_borders, {8, 16, 32, 64}, [](int n) { return 4 * n; }, small ? 6 : 10),
          scan(positive_borders, small ? std::vector{8, 16, 32} : std::vector{8, 16, 32, 64, 128, 256},
               [](int n) { return n / 4; }, 3));
  compare(report, "catenoid",
          scan([](int n, int steps) { return lamella_cost(false, n, steps); },
               small ? std::vector{8, 16} : std::vector{8, 12, 16, 24, 32}, [](int n) { return n * n / 4; }, 3),
          scan([](int n, int steps) { return lamella_cost(true, n, steps); },
               small ? std::vector{8, 16} : std::vector{8, 12, 16, 24, 32, 48}, [](int n) { return n / 2; },
               3));
}

}  // namespace spume::verification
