#include "spume/simulation/equilibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spume/simulation/equilibrium.hpp"

namespace spume::simulation {

namespace {

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, norm(a[v] - b[v]));
  return largest;
}

}  // namespace

std::string virial_text(const EquilibrateReport& report) {
  if (report.virial_error == 0) return "no outer pressure for the virial identity";
  return fmt::format("virial identity off by {:.2g}", report.virial_error);
}

EquilibrateReport equilibrate(const grid::Grid& grid, const Case& run_case, state::Foam& foam,
                              std::vector<state::Event>& events, const OnRelaxStep& on_step) {
  constexpr int most_steps = 2000, steps_between_reconstructions = 25;
  constexpr double largest_motion_cells = 0.5, rest = 1e-6;
  const double radius = mean_bubble_radius(foam.phases);
  const double tau = 0.05 * radius * radius;

  EquilibrateReport report;
  mesh::Topology topology = mesh::build_topology(foam.films);
  std::vector<Vec3> reference = foam.films.position;
  for (int since = 1; report.n_steps < most_steps; ++since) {
    const auto step = interface::relax_step(foam.films, foam.phases, tau);
    ++report.n_steps;
    report.virial_error = step.virial_error;
    report.area_change = std::abs(step.area_after / step.area_before - 1);
    if (!on_step(step, topology)) break;
    const double motion = largest_distance(foam.films.position, reference) / grid.h();
    report.converged = report.area_change < rest && motion < largest_motion_cells;
    if (report.converged) break;
    if (motion > largest_motion_cells || since >= steps_between_reconstructions) {
      FilmUpdate update = reconstruct_films(grid, run_case, foam);
      events.insert(events.end(), update.events.begin(), update.events.end());
      topology = std::move(update.topology);
      reference = foam.films.position;
      since = 0;
      ++report.n_reconstructions;
    }
  }
  return report;
}

}  // namespace spume::simulation
