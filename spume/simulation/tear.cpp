#include "spume/simulation/tear.hpp"

#include <fmt/format.h>

#include "spume/mesh/measure.hpp"

namespace spume::simulation {

FilmUpdate tear(const grid::Grid& grid, const Case& run_case, mesh::Phase a, mesh::Phase b,
                state::Foam& foam) {
  constexpr double injection_cells = 1.5;
  const auto report = rupture::rupture(a, b, foam.films, foam.liquid, foam.phases, run_case.rupture.liquid,
                                       injection_cells * grid.h());
  const double area_left = mesh::film_area(foam.films);
  FilmUpdate update;
  if (foam.phases.n_bubbles() > 0) {
    update = reconstruct_films(grid, run_case, mesh::build_topology(foam.films), foam);
  } else {
    update.topology = mesh::build_topology(foam.films);
  }
  const double area_reconstructed = mesh::film_area(foam.films);
  update.events.insert(
      update.events.begin(),
      {foam.time, "rupture",
       fmt::format(
           "film {}|{}: {} lamellae of {:.4g} m2; phase {} joined {}; liquid {:.4g} m3: {:.4g} to borders; "
           "{:.4g} "
           "injected into films; {:.4g} sprayed; reconstruction changed the film area by {:.2g} relative",
           a, b, report.n_lamellae, report.area, report.gone, report.kept, report.liquid, report.to_borders,
           report.to_films, report.sprayed, area_left > 0 ? area_reconstructed / area_left - 1 : 0.0)});
  return update;
}

}  // namespace spume::simulation
