#include "spume/interface/project_junction.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace spume::interface {

namespace {

std::span<const int> star(const mesh::Topology& topology, int v) {
  return std::span(topology.star_triangle)
      .subspan(topology.star_offset[v], topology.star_offset[v + 1] - topology.star_offset[v]);
}

/// PhasePotentials::handedness() of a junction of four phases as it is in the mesh; 0 of any other.
int handedness(const mesh::FilmMesh& films, const mesh::Topology& topology, int junction) {
  const mesh::PhaseSet& phases = topology.vertex_phases[junction];
  if (phases.size() != 4) return 0;
  const auto is_between = [&](int triangle, mesh::Phase a, mesh::Phase b) {
    return films.triangle[triangle].phase_a == a && films.triangle[triangle].phase_b == b;
  };
  const auto is_on_border = [&](int v) {
    return std::ranges::any_of(star(topology, junction), [&](int t) {
      return is_between(t, phases[1], phases[2]) && std::ranges::count(films.triangle[t].vertex, v) > 0;
    });
  };
  for (int t : star(topology, junction)) {
    if (!is_between(t, phases[0], phases[1])) continue;
    const auto& corner = films.triangle[t].vertex;
    const auto at = std::ranges::find(corner, junction) - corner.begin();
    // About an edge from the junction, the right-hand rule crosses the film along its normal if the edge is a
    // side of the triangle in its own direction.
    if (is_on_border(corner[(at + 1) % 3])) return 1;
    if (is_on_border(corner[(at + 2) % 3])) return -1;
  }
  return 0;
}

/// Phases of the vertices to which edges lead from the junction within `reach` [m], but for its own.
std::vector<mesh::Phase> phases_around(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                       int junction, double reach) {
  std::vector<int> reached{junction};
  std::vector<mesh::Phase> phases;
  for (std::size_t n = 0; n < reached.size(); ++n)
    for (int t : star(topology, reached[n])) {
      for (mesh::Phase p : {films.triangle[t].phase_a, films.triangle[t].phase_b})
        if (!topology.vertex_phases[junction].contains(p) && std::ranges::count(phases, p) == 0)
          phases.push_back(p);
      for (int v : films.triangle[t].vertex)
        if (norm_squared(films.edge(junction, v)) < reach * reach && std::ranges::count(reached, v) == 0)
          reached.push_back(v);
    }
  return phases;
}

}  // namespace

std::optional<Vec3> project_junction(const PhasePotentials& potentials, const mesh::FilmMesh& films,
                                     const mesh::Topology& topology, int junction) {
  constexpr double least_lead = 1e-6;  // of another phase [h]; Newton's method is good to 1e-10
  const mesh::PhaseSet& phases = topology.vertex_phases[junction];
  const double h = potentials.h();
  const auto point = potentials.project(films.position[junction], phases);
  if (!point) return std::nullopt;
  const int order = handedness(films, topology, junction);
  if (order != 0 && potentials.handedness(*point, phases) != order) return std::nullopt;
  const PhaseField& own = *potentials.find(phases[0]);
  for (mesh::Phase p : phases_around(films, topology, junction, h)) {
    const PhaseField* other = potentials.find(p);
    Vec3 gradient;
    if (other && potentials.difference(*other, own, *point, gradient) > least_lead * h) return std::nullopt;
  }
  return point;
}

}  // namespace spume::interface
