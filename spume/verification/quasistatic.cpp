#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <numeric>

#include "spume/mesh/measure.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/verification/clusters.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

struct Bands {
  double area, virial;
};

void equal_clusters(const parallel::Communicator& communicator, int cells_per_radius, const Bands& bands,
                    Report& report) {
  const Units units = units_of_laplace_number(1e3);
  for (const int n : {2, 3, 4}) {
    FoamRun run(communicator,
                with_cluster(cube_case(units, 4 * cells_per_radius + 12, cells_per_radius), units, n, 1.15));
    run.equilibrate();
    const ClusterErrors errors = errors_of_cluster(run, n);
    const std::string what = fmt::format("{} equal bubbles, R = {} h: ", n, cells_per_radius);
    report.absolute(what + "area error", errors.area, 0, bands.area, "exact geometry");
    report.at_most(what + "virial identity", errors.virial, bands.virial, "Σ p V = (2/3) 2σA");
    report.told(what + "border length error", errors.border_length, "exact geometry", 0);
    report.told(what + "pressure error", errors.pressure, "4σ/R", 0);
  }
}

void unequal_pair(const parallel::Communicator& communicator, int cells_per_radius, const Bands& bands,
                  Report& report) {
  const Units units = units_of_laplace_number(1e3);
  auto run_case = cube_case(units, 4 * cells_per_radius + 12, cells_per_radius);
  const double r = units.radius, small = std::cbrt(0.5) * r;
  run_case.foam.bubble = {{{-0.62 * r, 0.02 * r, 0.01 * r}, {small, small, small}},
                          {{0.5 * r, 0.02 * r, 0.01 * r}, {r, r, r}}};
  FoamRun run(communicator, run_case);
  run.foam().phases.target_volume[1] = 0.5 * run.foam().phases.target_volume[2];
  run.equilibrate();
  const auto& target = run.foam().phases.target_volume;
  const DoubleBubble exact = double_bubble_of_volumes(target[1], target[2]);
  const std::string what = fmt::format("two bubbles of volumes 1:2, R = {} h: ", cells_per_radius);
  report.relative(what + "area", mesh::film_area(run.foam().films), exact.area, bands.area, "exact geometry");
  report.at_most(what + "virial identity", virial_error(run), bands.virial, "Σ p V = (2/3) 2σA");
}

/// Three bubbles around an axis and one at each end.
void five_bubbles(const parallel::Communicator& communicator, int cells_per_radius, const Bands& bands,
                  Report& report) {
  const Units units = units_of_laplace_number(1e3);
  auto run_case = cube_case(units, 4 * cells_per_radius + 16, cells_per_radius);
  const double r = units.radius, around = 0.62 * r, end = 0.95 * r;
  const Vec3 middle = cluster_centre(units);
  for (const Vec3& c : equal_cluster_centres(3))
    run_case.foam.bubble.push_back({middle + around * std::sqrt(3.0) * c, {r, r, r}});
  for (const double side : {-1.0, 1.0})
    run_case.foam.bubble.push_back({middle + Vec3{0, 0, side * end}, {r, r, r}});
  FoamRun run(communicator, run_case);
  auto& target = run.foam().phases.target_volume;
  const double mean = std::accumulate(target.begin() + 1, target.end(), 0.0) / 5;
  std::fill(target.begin() + 1, target.end(), mean);
  run.equilibrate();
  const std::string what = fmt::format("five bubbles, R = {} h: ", cells_per_radius);
  report.relative(what + "area / V^(2/3)", mesh::film_area(run.foam().films) / std::pow(mean, 2.0 / 3),
                  five_bubble_area, bands.area, "independent minimiser");
  report.at_most(what + "virial identity", virial_error(run), bands.virial, "Σ p V = (2/3) 2σA");
}

void random_cluster(const parallel::Communicator& communicator, Report& report) {
  const Units units = units_of_laplace_number(1e3);
  auto run_case = cube_case(units, 64, 7);
  run_case.foam.cluster =
      simulation::ClusterShape{.count = 27, .mean_diameter = 2 * units.radius, .center = {}};
  FoamRun run(communicator, run_case);
  // Processor time: what it takes on a core of its own.
  std::vector<std::pair<double, double>> area_after;  // [s], [m²]
  const std::clock_t start = std::clock();
  simulation::equilibrate(run.grid(), run.run_case(), run.foam(), run.events,
                          [&](const interface::RelaxStepReport& step, const mesh::Topology&) {
                            area_after.emplace_back(
                                static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, step.area_after);
                            return true;
                          });
  const double area = mesh::film_area(run.foam().films);
  for (int more = 0; more < 2; ++more) {
    run.reconstruct();
    run.equilibrate();
  }
  const double final_area = mesh::film_area(run.foam().films);
  report.relative("27 bubbles, 64³: area after the first relaxation", area, final_area, 3e-4,
                  "after two more");
  double reached = 0;  // the last time that the area was farther off
  for (const auto& [spent, a] : area_after)
    if (a > (1 + 3e-4) * final_area) reached = spent;
  report.at_most("time to within 3e-4 of the final area [s]", communicator.max(reached), 10, "one core");
  report.told("time to rest [s]", area_after.back().first, "one core");
}

void random_foam(const parallel::Communicator& communicator, Report& report) {
  constexpr int count = 60;
  auto run_case = cube_case(units_of_laplace_number(1e3), 64, 10);
  run_case.foam.lattice = simulation::LatticeShape{
      .structure = simulation::LatticeShape::Structure::Random, .count = count, .spread = 0.2};
  FoamRun run(communicator, run_case);
  const std::clock_t start = std::clock();
  const auto relaxed = simulation::equilibrate(run.grid(), run.run_case(), run.foam(), run.events,
                                               [](const auto&, const auto&) { return true; });
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  report.at_most("60 bubbles that fill a periodic box, 64³: area to fall at rest",
                 relaxed.converged ? relaxed.area_to_fall : 1, 1e-5, "estimated from the last steps");
  report.told("steps", relaxed.n_steps, "until rest");
  report.told("reconstructions", relaxed.n_reconstructions, "until rest");
  report.told("time to rest [s]", communicator.max(seconds), "one core");
}

}  // namespace

void quasistatic(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("spheres that overlap by the wrong amount, relaxed without gas");
  constexpr double virial = 1e-4;
  for (const auto& [cells_per_radius, area] : {std::pair{8, 5e-4}, std::pair{16, 1.2e-4}}) {
    if (scale == Scale::Small && cells_per_radius > 8) break;
    equal_clusters(communicator, cells_per_radius, {area, virial}, report);
    unequal_pair(communicator, cells_per_radius, {area, virial}, report);
    five_bubbles(communicator, cells_per_radius, {area, virial}, report);
  }
  if (scale == Scale::Small) return;
  random_cluster(communicator, report);
  random_foam(communicator, report);
}

}  // namespace spume::verification
