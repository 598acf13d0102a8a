#include "spume/simulation/initial_foam.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "spume/base/error.hpp"
#include "spume/mesh/phase_frames.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/simulation/film_source.hpp"
#include "spume/simulation/start.hpp"
#include "spume/simulation/tear.hpp"

namespace spume::simulation {

namespace {

void report(const interface::ReconstructReport& report, std::vector<state::Event>& events) {
  using Kind = interface::ReconstructReport::PhaseChange::Kind;
  for (const auto& change : report.changes) {
    if (change.kind == Kind::Pocket)
      events.push_back({0, "pocket",
                        fmt::format("gas enclosed between the bubbles is bubble {}; volume {:.4g} m3",
                                    change.other, change.volume)});
    if (change.kind == Kind::Split)
      events.push_back({0, "bubble split",
                        fmt::format("a piece of bubble {} is bubble {}; volume {:.4g} m3", change.phase,
                                    change.other, change.volume)});
    if (change.kind == Kind::Lost)
      events.push_back({0, "bubble lost",
                        fmt::format("bubble {} is too small for the grid; volume {:.4g} m3", change.phase,
                                    change.volume)});
  }
}

/// A bubble that touches its own image through a periodic face is not one that films can bound.
void check_images_apart(const mesh::FilmMesh& films, int n_phases) {
  const mesh::PhaseFrames frames(films, n_phases);
  for (mesh::Phase p = 1; p < n_phases; ++p)
    for (int d = 0; d < 3; ++d)
      if (!frames.bounded(p, d))
        throw InputError(
            fmt::format("foam.lattice: bubble {} reaches through the box along {} and touches its own image; "
                        "take more bubbles or another seed",
                        p, "xyz"[d]));
}

/// Films between the phases as they lie at the start.
mesh::FilmMesh films_of(const Case& run_case, const grid::Grid& grid, state::Phases& phases,
                        std::vector<state::Event>& events) {
  Start start = start_of(run_case);
  phases.target_volume = std::move(start.target_volume);
  phases.above_membrane = start.above_membrane;
  auto construction = interface::construct(grid, start.potential, phases, run_case.reconstruct);
  report(construction.report, events);
  if (run_case.foam.lattice) check_images_apart(construction.films, phases.count());
  return std::move(construction.films);
}

/// Films and liquid of a file.
void take_films(const FilmsSource& source, const InitialFoam& start, state::Foam& foam,
                std::vector<state::Event>& events) {
  SourcedFilms sourced = load_films(source, start.lamella_half_thickness, start.border_area);
  foam.phases.target_volume = volumes_of(sourced.films);
  foam.films = std::move(sourced.films);
  foam.liquid = std::move(sourced.liquid);
  if (sourced.n_free_edges > 0)
    events.push_back(
        {0, "films end",
         fmt::format("at {} edges of a single triangle; nothing flows through them", sourced.n_free_edges)});
}

}  // namespace

void make_initial_foam(const Case& run_case, state::Foam& foam, std::vector<state::Event>& events,
                       const OnRelaxStep& on_step) {
  const grid::Grid& grid = foam.gas.pressure.grid();
  const auto& start = run_case.foam;
  if (start.films) {
    take_films(*start.films, start, foam, events);
    return;
  }
  foam.films = films_of(run_case, grid, foam.phases, events);
  const auto wet = [&] {
    foam.liquid = transport::uniform_liquid(foam.films, mesh::build_topology(foam.films),
                                            start.lamella_half_thickness, start.border_area);
  };
  wet();
  if (start.equilibrate) {
    const auto result = equilibrate(grid, run_case, foam, events, on_step);
    events.push_back({0, result.converged ? "equilibrated" : "equilibrium not reached",
                      fmt::format("{} steps; {} reconstructions; {}", result.n_steps,
                                  result.n_reconstructions, virial_text(result))});
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
