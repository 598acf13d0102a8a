#include "spume/drainage/suction.hpp"

#include <cmath>

#include "spume/drainage/constants.hpp"
#include "spume/fem/triangle_matrices.hpp"

namespace spume::drainage {

double suction(double eta, double lambda, const state::Materials& materials) {
  const double sigma = materials.film.surface_tension;  // σ [N/m]
  const double mu = materials.liquid.viscosity;         // μ [Pa s]
  return 0.5 * std::pow(border_shape / lambda, 0.75) * sigma / mu * eta * eta * std::sqrt(eta);
}

double suction_slope(double eta, double lambda, const state::Materials& materials) {
  return 2.5 * suction(eta, lambda, materials) / eta;
}

std::vector<SuctionSite> suction_sites(const state::FilmNetwork& network, const BorderNetwork& borders) {
  const auto& topology = network.topology;
  std::vector<double> length(topology.film_dof.size(), 0.0);
  for (const auto& edge : topology.border_edge) {
    const double h = norm(network.mesh.edge(edge.vertex[0], edge.vertex[1]));
    for (int t : edge.triangle)
      for (int corner = 0; corner < 3; ++corner) {
        const int v = network.mesh.triangle[t].vertex[corner];
        if (v == edge.vertex[0] || v == edge.vertex[1])
          length[topology.corner_dof[t][corner]] += fem::lumped_segment_mass(h);
      }
  }
  std::vector<SuctionSite> sites;
  for (std::size_t d = 0; d < length.size(); ++d)
    if (length[d] > 0)
      sites.push_back(
          {static_cast<int>(d), borders.unknown_of_vertex[topology.film_dof[d].vertex], length[d]});
  return sites;
}

void evaluate_suction(std::span<const SuctionSite> sites, std::span<const double> eta,
                      std::span<const double> lambda, const state::Materials& materials, Suction& result) {
  result.outflow.resize(sites.size());
  result.slope.resize(sites.size());
  for (std::size_t s = 0; s < sites.size(); ++s) {
    const double a = eta[sites[s].film_dof], b = lambda[sites[s].border_unknown];
    result.outflow[s] = sites[s].length * suction(a, b, materials);
    result.slope[s] = sites[s].length * suction_slope(a, b, materials);
  }
}

void add_border_source(std::span<const SuctionSite> sites, std::span<const double> outflow,
                       std::span<double> border_rate) {
  for (std::size_t s = 0; s < sites.size(); ++s) border_rate[sites[s].border_unknown] += outflow[s];
}

}  // namespace spume::drainage
