#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "spume/flow/navier_stokes.hpp"
#include "spume/verification/clusters.hpp"
#include "spume/verification/film_angles.hpp"
#include "spume/verification/modes.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

const char* name_of(int n) {
  return n == 1 ? "single bubble" : n == 2 ? "double bubble" : "tetrahedral cluster";
}

struct AtRest {
  double speed;  ///< largest, in units of sqrt(2σ/(ρR))
  double decay;  ///< kinetic energy at the end over its largest value
  ClusterErrors errors;
  PlateauAngles angles;
  int n_reconstructions = 0;
};

/// Two capillary times of an exact cluster. The box leaves seven cells at least around it.
AtRest at_rest(const parallel::Communicator& communicator, int n, int cells_per_radius, double laplace) {
  const Units units = units_of_laplace_number(laplace);
  const double width = n == 1 ? 3.0 : 4.0;
  const int cells = static_cast<int>(width * cells_per_radius) + (cells_per_radius < 16 ? 8 : 0);
  FoamRun run(communicator, with_cluster(cube_case(units, cells, cells_per_radius), units, n));
  put_onto_exact_cluster(run, units.radius);
  AtRest result{};
  double most_energy = 0, last_energy = 0;
  run.move_until(2 * units.time(), [&](const simulation::MotionStep& step) {
    most_energy = std::max(most_energy, step.kinetic_energy);
    last_energy = step.kinetic_energy;
    result.n_reconstructions += step.reconstructed;
    return true;
  });
  result.speed = flow::max_speed(run.foam().gas) / units.speed();
  result.decay = last_energy / most_energy;
  result.errors = errors_of_cluster(run, n);
  const double h = run.grid().h();
  result.angles = plateau_angles(run.foam().films, run.topology(), 4 * h, h);
  return result;
}

/// What four bubbles do in ten capillary times at rest.
struct Drift {
  double speed;  ///< largest, in units of sqrt(2σ/(ρR))
  double turn;   ///< angle by which the cluster has turned, of 0.01 h/R
};

Drift drift_of_four_bubbles(const parallel::Communicator& communicator, int cells_per_radius) {
  constexpr int n = 4;
  const Units units = units_of_laplace_number(1e5);
  FoamRun run(communicator,
              with_cluster(cube_case(units, 4 * cells_per_radius + 8, cells_per_radius), units, n));
  put_onto_exact_cluster(run, units.radius);
  const auto& films = run.foam().films;
  const auto centroids = [&] {
    std::vector<Vec3> c;
    for (mesh::Phase p = 1; p <= n; ++p) c.push_back(centroid(films, p) - cluster_centre(units));
    return c;
  };
  const std::vector<Vec3> start = centroids();
  run.move_until(10 * units.time());
  const std::vector<Vec3> end = centroids();
  Vec3 moment;
  double inertia = 0;  // of the corners of a regular tetrahedron, the same about all axes
  for (int p = 0; p < n; ++p) {
    moment += cross(start[p], end[p]);
    inertia += 2.0 / 3 * norm_squared(start[p]);
  }
  return {flow::max_speed(run.foam().gas) / units.speed(), norm(moment) / inertia * cells_per_radius / 0.01};
}

void judge(int n, const AtRest& at, Report& report) {
  const std::string what = name_of(n);
  report.at_most(what + ": largest speed, sqrt(2σ/(ρR))", at.speed, 0.016, "0 in an exact equilibrium");
  report.at_most(what + ": kinetic energy, of its largest", at.decay, 0.5, "decays, does not hover");
  report.absolute(what + ": pressure jump, relative error", at.errors.pressure, 0, 1e-3,
                  "4σ/R, Young-Laplace");
  if (n == 1) return;
  report.absolute(what + ": border length, relative error", at.errors.border_length, 0, 2e-3,
                  "exact geometry");
  report.absolute(what + ": film area, relative error", at.errors.area, 0, 2.5e-4, "exact geometry");
  if (n < 4) return;
  report.at_most(what + ": angles of films from 120°, rms", at.angles.film_rms, 0.3, "Plateau's laws");
  report.at_most(what + ": the same, largest", at.angles.film_largest, 1.5, "Plateau's laws");
  report.at_most(what + ": angles of borders from 109.47°", at.angles.border_largest, 0.7, "Plateau's laws");
}

}  // namespace

void static_currents(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("clusters that start in exact equilibrium, after two capillary times sqrt(ρR³/2σ)");
  const std::vector<int> radii = scale == Scale::Full ? std::vector<int>{8, 16, 24} : std::vector<int>{8, 12};
  for (const int n : {1, 2, 4}) {
    double coarser = 0;
    for (const int cells_per_radius : radii) {
      const AtRest at = at_rest(communicator, n, cells_per_radius, 1e5);
      report.note(fmt::format("{}, R = {} h, La = 1e5, {} reconstructions:", name_of(n), cells_per_radius,
                              at.n_reconstructions));
      if (cells_per_radius == 16)
        judge(n, at, report);
      else
        report.told(std::string(name_of(n)) + ": largest speed, sqrt(2σ/(ρR))", at.speed, "0");
      if (coarser > 0)
        report.at_most("its ratio to that of the coarser grid", at.speed / coarser, 1, "falls");
      coarser = at.speed;
    }
    if (scale == Scale::Small) continue;
    for (const double laplace : {1e3, 2.7e6})
      report.told(fmt::format("{}: largest speed, R = 16 h, La = {:.1e}", name_of(n), laplace),
                  at_rest(communicator, n, 16, laplace).speed, "0");
  }
  report.note("four bubbles for ten capillary times");
  double coarser = 0;
  for (const int cells_per_radius : scale == Scale::Full ? std::vector<int>{8, 12} : std::vector<int>{8}) {
    const Drift drift = drift_of_four_bubbles(communicator, cells_per_radius);
    report.told(fmt::format("R = {} h: largest speed, sqrt(2σ/(ρR))", cells_per_radius), drift.speed, "0");
    report.at_most(fmt::format("R = {} h: turned by, of 0.01 h/R", cells_per_radius), drift.turn, 1,
                   "0: films move by less than 0.01 h");
    if (coarser > 0)
      report.at_most("its speed over that of the coarser grid", drift.speed / coarser, 1, "falls");
    coarser = drift.speed;
  }
}

}  // namespace spume::verification
