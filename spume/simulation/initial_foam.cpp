#include "spume/simulation/initial_foam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spume/base/error.hpp"
#include "spume/simulation/cluster.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/simulation/tear.hpp"

namespace spume::simulation {

namespace {

void check_inside(const std::vector<BubbleShape>& bubbles, const grid::Box& box) {
  constexpr int margin_cells = 4;
  const double margin = margin_cells * box.spacing();
  for (std::size_t b = 0; b < bubbles.size(); ++b)
    for (int d = 0; d < 3; ++d)
      if (bubbles[b].center[d] - bubbles[b].semi_axes[d] < box.lower[d] + margin ||
          bubbles[b].center[d] + bubbles[b].semi_axes[d] > box.upper[d] - margin)
        throw InputError(
            fmt::format("bubble {} reaches to within {} cells ({:.3g} m) of the edge of the box across {}: "
                        "centre {:.6g} m, radius "
                        "{:.6g} m, box from {:.6g} to {:.6g} m; enlarge [domain] or move the bubble",
                        b + 1, margin_cells, margin, "xyz"[d], bubbles[b].center[d], bubbles[b].semi_axes[d],
                        box.lower[d], box.upper[d]));
}

/// Films between the power cells of the bubbles. Where the case has a cluster, gas enclosed between bubbles
/// is shared by them; among the user's own bubbles it becomes a bubble of its own.
interface::Reconstruction films_of(const Case& run_case, const grid::Grid& grid,
                                   const std::vector<BubbleShape>& bubbles, state::Phases& phases) {
  const double radius = mean_radius(bubbles), h = grid.h();
  const grid::Box& box = run_case.box;
  std::vector<char> shared(grid.total_size(), 0);
  if (run_case.foam.cluster) shared = enclosed_pockets(bubbles, box);
  const auto is_shared = [&](const Vec3& x) {
    Index3 cell;
    for (int d = 0; d < 3; ++d)
      cell[d] = std::clamp(static_cast<int>((x[d] - box.lower[d]) / h), 0, box.cells[d] - 1);
    return shared[(static_cast<std::size_t>(cell.k) * box.cells.j + cell.j) * box.cells.i + cell.i] != 0;
  };
  const auto potential = [&](mesh::Phase phase, const Vec3& x) {
    if (phase > 0) return power_potential(bubbles[phase - 1], x, radius);
    if (is_shared(x)) return -10 * radius;
    double nearest = -1e300;
    for (const auto& bubble : bubbles) nearest = std::max(nearest, power_potential(bubble, x, radius));
    return -nearest;
  };
  phases.target_volume.assign(bubbles.size() + 1, 0.0);
  return interface::construct(grid, potential, phases, run_case.reconstruct);
}

void report(const interface::ReconstructReport& report, std::vector<state::Event>& events) {
  using Kind = interface::ReconstructReport::PhaseChange::Kind;
  for (const auto& change : report.changes) {
    if (change.kind == Kind::Pocket)
      events.push_back({0, "pocket",
                        fmt::format("gas enclosed between the bubbles is bubble {}; volume {:.4g} m3",
                                    change.other, change.volume)});
    if (change.kind == Kind::Lost)
      events.push_back({0, "bubble lost",
                        fmt::format("bubble {} is too small for the grid; volume {:.4g} m3", change.phase,
                                    change.volume)});
  }
}

}  // namespace

std::vector<BubbleShape> bubbles_of(const Case& run_case) {
  std::vector<BubbleShape> bubbles = run_case.foam.bubble;
  if (run_case.foam.cluster) {
    const auto cluster = make_cluster(*run_case.foam.cluster, run_case.box);
    bubbles.insert(bubbles.end(), cluster.begin(), cluster.end());
  }
  if (bubbles.empty())
    throw InputError("the case has no bubble: give [[foam.bubble]] entries or a [foam.cluster] section");
  check_inside(bubbles, run_case.box);
  return bubbles;
}

void make_initial_foam(const Case& run_case, state::Foam& foam, std::vector<state::Event>& events) {
  const grid::Grid& grid = foam.gas.pressure.grid();
  const auto& start = run_case.foam;
  auto construction = films_of(run_case, grid, bubbles_of(run_case), foam.phases);
  report(construction.report, events);
  foam.films = std::move(construction.films);
  const auto wet = [&] {
    foam.liquid = transport::uniform_liquid(foam.films, mesh::build_topology(foam.films),
                                            start.lamella_half_thickness, start.border_area);
  };
  wet();
  if (start.equilibrate) {
    const auto result =
        equilibrate(grid, run_case, foam, events, [](const auto&, const auto&) { return true; });
    events.push_back({0, result.converged ? "equilibrated" : "equilibrium not reached",
                      fmt::format("{} steps; {} reconstructions; virial identity off by {:.2g}",
                                  result.n_steps, result.n_reconstructions, result.virial_error)});
    wet();
  }
  for (const auto& [a, b] : start.remove_lamella) {
    const auto topology = mesh::build_topology(foam.films);
    const bool share_film =
        std::any_of(topology.lamella.begin(), topology.lamella.end(), [&](const auto& lamella) {
          return lamella.phase_a == std::min(a, b) && lamella.phase_b == std::max(a, b);
        });
    if (!share_film)
      throw InputError(
          fmt::format("foam.remove_lamella: bubbles {} and {} share no film (a bubble that was merged by an "
                      "earlier pair has the lower number of the two)",
                      a, b));
    const auto update = tear(grid, run_case, a, b, foam);
    events.insert(events.end(), update.events.begin(), update.events.end());
  }
}

}  // namespace spume::simulation
