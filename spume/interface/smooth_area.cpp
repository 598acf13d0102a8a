#include "spume/interface/smooth_area.hpp"

#include <vector>

#include "spume/interface/curved_triangles.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::interface {

namespace {

/// Every triangle cut into four whose new corners are on the curved film. Edges have a midpoint for each of
/// their triangles, which areas and volumes do not mind.
mesh::FilmMesh subdivided(const mesh::FilmMesh& films, const std::vector<EdgeMidpoints>& midpoints) {
  mesh::FilmMesh fine{films.position, {}, films.domain};
  fine.triangle.reserve(4 * films.triangle.size());
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto& [v, a, b] = films.triangle[t];
    const int m = fine.n_vertices();
    fine.position.insert(fine.position.end(), midpoints[t].begin(), midpoints[t].end());
    fine.triangle.insert(fine.triangle.end(), {{{v[0], m, m + 2}, a, b},
                                               {{m, v[1], m + 1}, a, b},
                                               {{m + 2, m + 1, v[2]}, a, b},
                                               {{m, m + 1, m + 2}, a, b}});
  }
  return fine;
}

double extrapolated(double coarse, double fine) {
  return (4 * fine - coarse) / 3;
}

std::vector<double> extrapolated(std::vector<double> coarse, const std::vector<double>& fine) {
  for (std::size_t n = 0; n < coarse.size(); ++n) coarse[n] = extrapolated(coarse[n], fine[n]);
  return coarse;
}

}  // namespace

std::vector<double> smooth_phase_volumes(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                         int n_phases) {
  const mesh::FilmMesh fine = subdivided(films, edge_midpoints(films, topology));
  return extrapolated(mesh::phase_volumes(films, n_phases), mesh::phase_volumes(fine, n_phases));
}

double smooth_film_area(const mesh::FilmMesh& films, const mesh::Topology& topology,
                        const state::Phases& phases) {
  const mesh::FilmMesh fine = subdivided(films, edge_midpoints(films, topology));
  const int n = phases.count();
  const auto volume = extrapolated(mesh::phase_volumes(films, n), mesh::phase_volumes(fine, n));
  const auto pressure = mesh::film_pressures(films, topology, mesh::area_descent(films), n);
  double area = extrapolated(mesh::film_area(films), mesh::film_area(fine));
  for (mesh::Phase p = 1; p < n; ++p)
    if (phases.alive(p)) area -= pressure[p] * (volume[p] - phases.target_volume[p]);
  return area;
}

}  // namespace spume::interface
