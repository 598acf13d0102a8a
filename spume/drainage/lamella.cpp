#include "spume/drainage/lamella.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace spume::drainage {
namespace {

/// Local unknown of each film dof, in the order of the dofs within each lamella.
std::vector<int> number_locally(const state::FilmNetwork& network, std::vector<LamellaDomain>& lamellae) {
  std::vector<int> local;
  local.reserve(network.topology.film_dof.size());
  for (std::size_t d = 0; d < network.topology.film_dof.size(); ++d) {
    LamellaDomain& lamella = lamellae[network.topology.film_dof[d].lamella];
    local.push_back(lamella.size());
    lamella.film_dof.push_back(static_cast<int>(d));
  }
  return local;
}

void fill_domain(const state::FilmNetwork& network, const Vec3& gravity,
                 std::span<const std::array<int, 3>> triangles, LamellaDomain& lamella) {
  std::vector<Vec3> position;
  for (int d : lamella.film_dof) {
    const Vec3& x = network.mesh.position[network.topology.film_dof[d].vertex];
    position.push_back(position.empty() ? x : network.mesh.domain.near(x, position.front()));
    lamella.curvature_squared.push_back(network.curvature_squared[d]);
    lamella.descent.push_back(dot(gravity, position.back() - position.front()));
  }
  lamella.surface = fem::assemble_surface_laplacian(position, triangles, network.mesh.domain);
}

/// σ/3μ [m/s].
double capillary_speed(const state::Materials& materials) {
  return materials.film.surface_tension / (3 * materials.liquid.viscosity);
}

}  // namespace

std::vector<LamellaDomain> build_lamella_domains(const state::FilmNetwork& network, const Vec3& gravity,
                                                 std::span<const SuctionSite> sites,
                                                 const std::vector<int>& lamellae) {
  const auto& topology = network.topology;
  std::vector<LamellaDomain> all(topology.n_lamellae());
  const std::vector<int> local = number_locally(network, all);
  std::vector<std::vector<std::array<int, 3>>> triangles(topology.n_lamellae());
  for (int t = 0; t < network.mesh.n_triangles(); ++t) {
    const auto& dof = topology.corner_dof[t];
    triangles[topology.triangle_lamella[t]].push_back({local[dof[0]], local[dof[1]], local[dof[2]]});
  }
  for (std::size_t s = 0; s < sites.size(); ++s) {
    const int d = sites[s].film_dof;
    all[topology.film_dof[d].lamella].rim.push_back({local[d], static_cast<int>(s)});
  }
  std::vector<LamellaDomain> wanted;
  for (int l : lamellae) {
    fill_domain(network, gravity, triangles[l], all[l]);
    wanted.push_back(std::move(all[l]));
  }
  return wanted;
}

EdgeMobility edge_mobility(double a, double b) {
  const double ratio = 2 * a * b / (a + b);  // harmonic mean; the mobility is a·b times it
  return {a * b * ratio, ratio * b * (a + 2 * b) / (a + b), ratio * a * (b + 2 * a) / (a + b)};
}

void lamella_potential(const LamellaDomain& lamella, std::span<const double> eta,
                       const state::Materials& materials, std::span<double> potential) {
  const auto& surface = lamella.surface;
  const double speed = capillary_speed(materials);
  const double weight = materials.liquid.density / (3 * materials.liquid.viscosity);  // ρ/3μ [s/m²]
  for (int i = 0; i < lamella.size(); ++i) {
    double k_eta = 0;  // (Kη)_i [m]
    for (int e = surface.offset[i]; e < surface.offset[i + 1]; ++e)
      k_eta += surface.stiffness[e] * (eta[surface.neighbour[e]] - eta[i]);
    potential[i] = speed * (lamella.curvature_squared[i] * eta[i] - k_eta / surface.mass[i]) +
                   weight * lamella.descent[i];
  }
}

void add_lamella_flow(const LamellaDomain& lamella, std::span<const double> eta,
                      std::span<const double> potential, std::span<double> rate) {
  const auto& surface = lamella.surface;
  for (int i = 0; i < lamella.size(); ++i)
    for (int e = surface.offset[i]; e < surface.offset[i + 1]; ++e) {
      const int j = surface.neighbour[e];
      if (j < i) continue;
      const double flow =
          surface.stiffness[e] * edge_mobility(eta[i], eta[j]).value * (potential[j] - potential[i]);
      rate[i] += flow;
      rate[j] -= flow;
    }
}

void add_boundary_outflow(const LamellaDomain& lamella, std::span<const double> outflow,
                          std::span<double> rate) {
  for (const RimNode& node : lamella.rim) rate[node.unknown] -= 0.5 * outflow[node.site];
}

LamellaJacobian::LamellaJacobian(const LamellaDomain& lamella) {
  const int n = lamella.size();
  column_offset_.push_back(0);
  for (int j = 0; j < n; ++j) {
    const std::vector<int> ring = fem::second_ring(lamella.surface, j);
    const auto self = std::lower_bound(ring.begin(), ring.end(), j);
    diagonal_.push_back(column_offset_.back() + static_cast<int>(self - ring.begin()));
    row_.insert(row_.end(), ring.begin(), ring.end());
    column_offset_.push_back(static_cast<int>(row_.size()));
  }
  value_.resize(row_.size());
  conductance_.resize(lamella.surface.neighbour.size());
  edge_slope_.resize(lamella.surface.neighbour.size());
  work_.assign(n, 0.0);
}

void LamellaJacobian::evaluate_edges(const LamellaDomain& lamella, std::span<const double> eta,
                                     std::span<const double> potential) {
  const auto& surface = lamella.surface;
  for (int i = 0; i < lamella.size(); ++i)
    for (int e = surface.offset[i]; e < surface.offset[i + 1]; ++e) {
      const int j = surface.neighbour[e];
      const EdgeMobility mobility = edge_mobility(eta[i], eta[j]);
      conductance_[e] = surface.stiffness[e] * mobility.value;
      edge_slope_[e] = surface.stiffness[e] * mobility.slope_a * (potential[j] - potential[i]);
    }
}

/// Adds to the column in work_ what a change of the potential of one node does to it and its neighbours.
void LamellaJacobian::add_column_of_potential(const LamellaDomain& lamella, int node,
                                              double slope_of_potential) {
  const auto& surface = lamella.surface;
  for (int e = surface.offset[node]; e < surface.offset[node + 1]; ++e) {
    const double flow = conductance_[e] * slope_of_potential;
    work_[surface.neighbour[e]] += flow;
    work_[node] -= flow;
  }
}

void LamellaJacobian::evaluate(const LamellaDomain& lamella, std::span<const double> eta,
                               std::span<const double> potential, const state::Materials& materials,
                               std::span<const double> slope) {
  const auto& surface = lamella.surface;
  const double speed = capillary_speed(materials);
  evaluate_edges(lamella, eta, potential);
  for (int j = 0; j < lamella.size(); ++j) {
    double sum_k = 0;  // Σ_l K_jl = −K_jj
    for (int e = surface.offset[j]; e < surface.offset[j + 1]; ++e) {
      const int l = surface.neighbour[e];
      sum_k += surface.stiffness[e];
      add_column_of_potential(lamella, l, -speed * surface.stiffness[e] / surface.mass[l]);
      work_[j] += edge_slope_[e];
      work_[l] -= edge_slope_[e];
    }
    add_column_of_potential(lamella, j, speed * (lamella.curvature_squared[j] + sum_k / surface.mass[j]));
    for (int p = column_offset_[j]; p < column_offset_[j + 1]; ++p) {
      value_[p] = work_[row_[p]];
      work_[row_[p]] = 0;
    }
  }
  for (const RimNode& node : lamella.rim) value_[diagonal_[node.unknown]] -= 0.5 * slope[node.site];
}

}  // namespace spume::drainage
