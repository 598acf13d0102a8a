#include "spume/rupture/criterion.hpp"

#include <algorithm>
#include <vector>

#include "spume/mesh/measure.hpp"

namespace spume::rupture {

namespace {

/// The tail of a sliver at a lamella's rim has hardly any area, and η there is no measurement.
constexpr double smallest_dof_share = 0.05;

bool is_protected(const mesh::Lamella& lamella, const RuptureParameters& parameters) {
  return std::any_of(
      parameters.protect.begin(), parameters.protect.end(), [&](const std::array<int, 2>& pair) {
        return std::minmax(pair[0], pair[1]) == std::minmax<int>(lamella.phase_a, lamella.phase_b);
      });
}

bool near_junction(const state::FilmNetwork& network, int vertex, double radius) {
  if (network.topology.vertex_kind[vertex] == mesh::VertexKind::Film) return false;
  const Vec3& x = network.mesh.position[vertex];
  return std::any_of(network.topology.junction.begin(), network.topology.junction.end(), [&](int junction) {
    return norm_squared(network.mesh.domain.step(x, network.mesh.position[junction])) <= radius * radius;
  });
}

/// Smallest lumped area that a dof of each lamella must have to count [m²]; negative: none of the lamella
/// counts.
std::vector<double> least_dof_areas(const state::FilmNetwork& network, const RuptureParameters& parameters,
                                    double smallest_area) {
  const mesh::Topology& topology = network.topology;
  const std::vector<double> area = mesh::lamella_areas(network.mesh, topology);
  std::vector<int> n_dofs(topology.lamella.size(), 0);
  for (const auto& dof : topology.film_dof) ++n_dofs[dof.lamella];
  std::vector<double> least(topology.lamella.size());
  for (std::size_t l = 0; l < least.size(); ++l) {
    const bool counts = area[l] >= smallest_area && !is_protected(topology.lamella[l], parameters);
    least[l] = counts ? smallest_dof_share * area[l] / n_dofs[l] : -1;
  }
  return least;
}

}  // namespace

state::ThinPoint thinnest_point(const state::FilmNetwork& network, const RuptureParameters& parameters,
                                double smallest_area) {
  const mesh::Topology& topology = network.topology;
  const std::vector<double> least_area = least_dof_areas(network, parameters, smallest_area);
  const std::vector<double> dof_area = mesh::film_dof_areas(network.mesh, topology);
  state::ThinPoint thinnest;
  for (std::size_t d = 0; d < topology.film_dof.size(); ++d) {
    const auto& dof = topology.film_dof[d];
    if (least_area[dof.lamella] < 0 || dof_area[d] < least_area[dof.lamella]) continue;
    const double eta = network.half_thickness[d];
    if (thinnest.film_dof >= 0 && eta >= thinnest.half_thickness) continue;
    if (parameters.criterion == Criterion::Film &&
        near_junction(network, dof.vertex, parameters.corner_radius))
      continue;
    thinnest = {static_cast<int>(d), dof.lamella, eta, topology.vertex_kind[dof.vertex]};
  }
  return thinnest;
}

}  // namespace spume::rupture
