#include <fmt/format.h>

#include <cmath>

#include "spume/mesh/measure.hpp"
#include "spume/verification/clusters.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

constexpr double laplace = 400;    // near aperiodic: comes to rest in a few capillary times
constexpr double rest_times = 14;  // exp(−0.45 · 14) = 0.2 % of the first motion is left, 4e-6 of its energy

void equal_bubbles(const parallel::Communicator& communicator, int n, Scale scale, Report& report) {
  const int cells = scale == Scale::Full ? 64 : 40;
  const double wider = scale == Scale::Full ? 1 : 2.56;  // of the bands: (64/40)²
  const Units units = units_of_laplace_number(laplace);
  const double cells_per_radius = 12.0 * cells / 64;
  report.note(fmt::format("{} spheres too far apart by 15 %, R = {:.1f} h, box {}³, gas until rest", n,
                          cells_per_radius, cells));
  FoamRun run(communicator, with_cluster(cube_case(units, cells, cells_per_radius), units, n, 1.15));
  run.move_until(rest_times * units.time());
  const ClusterErrors errors = errors_of_cluster(run, n);
  report.absolute("film area, relative error", errors.area, 0, 1e-3 * wider, "exact geometry");
  report.absolute("border length, relative error", errors.border_length, 0, 5e-3 * wider, "exact geometry");
  report.absolute("pressure, relative error", errors.pressure, 0, 3e-3 * wider, "4σ/R, Young-Laplace");
  report.at_most("virial identity", errors.virial, 2e-3 * wider, "Σ p V = (2/3) 2σA");
  report.at_most("volumes, relative error", errors.volume, 1e-4, "targets");
}

}  // namespace

void double_bubble(const parallel::Communicator& communicator, Scale scale, Report& report) {
  equal_bubbles(communicator, 2, scale, report);
}
void triple_bubble(const parallel::Communicator& communicator, Scale scale, Report& report) {
  equal_bubbles(communicator, 3, scale, report);
}
void tetrahedral_cluster(const parallel::Communicator& communicator, Scale scale, Report& report) {
  equal_bubbles(communicator, 4, scale, report);
}

void unequal_double_bubble(const parallel::Communicator& communicator, Scale scale, Report& report) {
  const int cells = scale == Scale::Full ? 64 : 40;
  const double wider = scale == Scale::Full ? 1 : 2.56;
  const Units units = units_of_laplace_number(laplace);
  auto run_case = cube_case(units, cells, 13.0 * cells / 64);
  const double r = units.radius, small = std::cbrt(0.5) * r;
  run_case.foam.bubble = {{{-0.9 * r, 0.02 * r, 0.01 * r}, {small, small, small}},
                          {{0.4 * r, 0.02 * r, 0.01 * r}, {r, r, r}}};
  report.note(fmt::format(
      "spheres of volumes 1:2 with the wrong overlap, larger R = {:.1f} h, box {}³, gas until rest",
      13.0 * cells / 64, cells));
  FoamRun run(communicator, run_case);
  auto& target = run.foam().phases.target_volume;
  target[1] = 0.5 * target[2];
  run.move_until(rest_times * units.time());

  const DoubleBubble exact = double_bubble_of_volumes(target[1], target[2]);
  const auto& topology = run.topology();
  const auto length = mesh::border_lengths(run.foam().films, topology);
  const auto pressure = bubble_pressures(run);
  report.relative("film area", mesh::film_area(run.foam().films), exact.area, 1e-3 * wider, "exact geometry");
  report.relative("border length", length.size() == 1 ? length[0] : 0, exact.border_length, 5e-3 * wider,
                  "exact geometry");
  report.relative("pressure of the smaller", pressure[1], 2 * units.tension / exact.radius_1, 3e-3 * wider,
                  "4σ/r");
  report.relative("pressure of the larger", pressure[2], 2 * units.tension / exact.radius_2, 3e-3 * wider,
                  "4σ/r");
  report.at_most("virial identity", virial_error(run), 2e-3 * wider, "Σ p V = (2/3) 2σA");
}

}  // namespace spume::verification
