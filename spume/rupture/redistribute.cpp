#include "spume/rupture/redistribute.hpp"

#include <algorithm>
#include <cmath>

namespace spume::rupture {

std::vector<double> border_edge_lengths(const mesh::FilmMesh& films, const mesh::Topology& topology) {
  std::vector<double> length;
  for (const auto& edge : topology.border_edge)
    length.push_back(norm(films.edge(edge.vertex[0], edge.vertex[1])));
  return length;
}

TornLiquid redistribute(const mesh::FilmMesh& films, const mesh::Topology& topology,
                        std::span<const char> is_torn, std::span<const double> lamella_volume) {
  const std::vector<double> length = border_edge_lengths(films, topology);
  std::vector<double> holds(topology.lamella.size(), 0), rim(topology.lamella.size(), 0);
  for (std::size_t d = 0; d < lamella_volume.size(); ++d)
    holds[topology.film_dof[d].lamella] += lamella_volume[d];
  for (std::size_t e = 0; e < length.size(); ++e)
    for (int t : topology.border_edge[e].triangle) rim[topology.triangle_lamella[t]] += length[e];

  TornLiquid torn;
  torn.on_edge.assign(length.size(), 0);
  for (std::size_t e = 0; e < length.size(); ++e)
    for (int t : topology.border_edge[e].triangle) {
      const int lamella = topology.triangle_lamella[t];
      if (!is_torn[lamella] || !(rim[lamella] > 0)) continue;
      torn.on_edge[e] += holds[lamella] * (length[e] / rim[lamella]);
    }
  for (std::size_t l = 0; l < is_torn.size(); ++l)
    if (is_torn[l] && rim[l] > 0) torn.to_borders += holds[l];
  for (std::size_t d = 0; d < lamella_volume.size(); ++d) {
    const int lamella = topology.film_dof[d].lamella;
    if (is_torn[lamella] && !(rim[lamella] > 0)) torn.without_border.push_back(static_cast<int>(d));
  }
  return torn;
}

}  // namespace spume::rupture
