#include "spume/transport/liquid_mesh.hpp"

#include <algorithm>
#include <utility>

#include "spume/mesh/measure.hpp"

namespace spume::transport {

namespace {

template <class Dof>
std::vector<Vec3> positions_of(const mesh::FilmMesh& films, const std::vector<Dof>& dofs) {
  std::vector<Vec3> positions;
  positions.reserve(dofs.size());
  for (const Dof& dof : dofs) positions.push_back(films.position[dof.vertex]);
  return positions;
}

/// A border edge lies on the rims of the lamellae of its three triangles.
Grouping rims(const mesh::Topology& topology) {
  std::vector<int> lamella_of_side, edge_of_side;
  for (std::size_t e = 0; e < topology.border_edge.size(); ++e)
    for (int t : topology.border_edge[e].triangle) {
      lamella_of_side.push_back(topology.triangle_lamella[t]);
      edge_of_side.push_back(static_cast<int>(e));
    }
  Grouping rim = group_members(topology.n_lamellae(), lamella_of_side);
  for (int& side : rim.member) side = edge_of_side[side];
  return rim;
}

}  // namespace

LiquidMesh measure_liquid_mesh(const mesh::FilmMesh& films, const mesh::Topology& topology, double h) {
  std::vector<int> lamella_of_dof, border_of_dof;
  for (const auto& dof : topology.film_dof) lamella_of_dof.push_back(dof.lamella);
  for (const auto& dof : topology.border_dof) border_of_dof.push_back(dof.border);
  Grouping dofs_of_lamella = group_members(topology.n_lamellae(), lamella_of_dof);
  Grouping dofs_of_border = group_members(topology.n_borders(), border_of_dof);
  return {films,
          topology,
          mesh::film_dof_areas(films, topology),
          mesh::lamella_areas(films, topology),
          mesh::border_dof_lengths(films, topology),
          mesh::border_lengths(films, topology),
          std::move(lamella_of_dof),
          std::move(border_of_dof),
          std::move(dofs_of_lamella),
          std::move(dofs_of_border),
          rims(topology),
          PointBins(positions_of(films, topology.film_dof), h, films.domain),
          PointBins(positions_of(films, topology.border_dof), h, films.domain)};
}

}  // namespace spume::transport
