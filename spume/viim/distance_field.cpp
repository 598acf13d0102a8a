#include "spume/viim/distance_field.hpp"

#include <array>
#include <map>
#include <utility>

#include "spume/interface/curved_triangles.hpp"
#include "spume/viim/closest_points.hpp"
#include "spume/viim/local_cubic.hpp"

namespace spume::viim {

namespace {

/// Every triangle in four, through the midpoints of its curved sides.
mesh::FilmMesh divided(const mesh::FilmMesh& films, const std::vector<interface::EdgeMidpoints>& midpoints) {
  mesh::FilmMesh fine{films.position, {}, films.domain};
  fine.triangle.reserve(4 * films.triangle.size());
  std::map<std::pair<int, int>, int> middle_of_edge;
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto& [v, a, b] = films.triangle[t];
    std::array<int, 3> middle;
    for (int e = 0; e < 3; ++e) {
      const auto [known, is_new] =
          middle_of_edge.try_emplace(std::minmax(v[e], v[(e + 1) % 3]), fine.n_vertices());
      if (is_new) fine.position.push_back(midpoints[t][e]);
      middle[e] = known->second;
    }
    for (int c = 0; c < 3; ++c) fine.triangle.push_back({{v[c], middle[c], middle[(c + 2) % 3]}, a, b});
    fine.triangle.push_back({middle, a, b});
  }
  return fine;
}

bool lies_on_border(const mesh::FilmMesh& films, const mesh::Topology& topology, const ClosestPoint& p) {
  for (int c = 0; c < 3; ++c)
    if (p.weight[c] > 0 &&
        topology.vertex_kind[films.triangle[p.triangle].vertex[c]] == mesh::VertexKind::Film)
      return false;
  return true;
}

double distance_to_film(const interface::PhasePotentials& potentials, const mesh::FilmTriangle& triangle,
                        const ClosestPoint& p) {
  const auto *a = potentials.find(triangle.phase_a), *b = potentials.find(triangle.phase_b);
  if (!a || !b) return p.distance;
  const LocalCubic cubic(potentials.box(), p.point,
                         [&](int i, int j, int k) { return 0.5 * (a->at(i, j, k) - b->at(i, j, k)); });
  const auto foot = cubic.closest_zero(p.centre, p.point);
  return foot ? norm(p.centre - *foot) : p.distance;
}

}  // namespace

DistanceField distance_to(const mesh::FilmMesh& films, const mesh::Topology& topology, const grid::Box& box,
                          std::vector<mesh::Phase> phase_of_cell) {
  const double far = band_cells * box.spacing();
  DistanceField field{box, std::vector<double>(phase_of_cell.size(), far), std::move(phase_of_cell)};
  for (const auto& p : closest_points(divided(films, interface::edge_midpoints(films, topology)), box, far))
    field.distance[p.cell] = p.distance;
  return field;
}

DistanceField distance_to(const mesh::FilmMesh& films, const mesh::Topology& topology,
                          const interface::PhasePotentials& potentials) {
  const grid::Box& box = potentials.box();
  const double far = band_cells * box.spacing();
  DistanceField field{box, {}, interface::find_winners(potentials)};
  field.distance.assign(field.phase.size(), far);
  for (const auto& p : closest_points(films, box, far))
    field.distance[p.cell] = lies_on_border(films, topology, p)
                                 ? p.distance
                                 : distance_to_film(potentials, films.triangle[p.triangle], p);
  return field;
}

std::vector<double> signed_distance(const DistanceField& field, mesh::Phase phase,
                                    const interface::CellBox& cells) {
  const interface::CellBox whole = interface::all_cells(field.box.cells);
  std::vector<double> s;
  s.reserve(cells.size());
  interface::for_each_cell(cells, [&](int i, int j, int k) {
    const std::size_t cell = whole.offset(i, j, k);
    s.push_back(field.phase[cell] == phase ? field.distance[cell] : -field.distance[cell]);
  });
  return s;
}

}  // namespace spume::viim
