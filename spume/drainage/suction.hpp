#pragma once

#include <span>
#include <vector>

#include "spume/drainage/plateau_border.hpp"
#include "spume/state/film_network.hpp"
#include "spume/state/materials.hpp"

namespace spume::drainage {

/// Liquid that a Plateau border of cross-section λ sucks out of one film of half-thickness η [m²/s]: per
/// length of border, from both faces of the film together.
/// Paper: Sec. 3.3.4, Eq. (16).
///   Q = ½ (√3 − π/2)^{3/4} σ η^{5/2} / (μ λ^{3/4})
double suction(double eta, double lambda, const state::Materials& materials);

/// ∂Q/∂η of suction() [m/s].
double suction_slope(double eta, double lambda, const state::Materials& materials);

/// Where a film meets a border: one film dof, one border unknown, and the length over which they touch.
struct SuctionSite {
  int film_dof;
  int border_unknown;
  double length;  ///< half of the border edges of this film at this vertex [m]
};

/// All sites, in the order of the film dofs.
std::vector<SuctionSite> suction_sites(const state::FilmNetwork& network, const BorderNetwork& borders);

/// Suction at the sites. Both the films and the borders read this one array, which is why no liquid is lost
/// between them.
struct Suction {
  std::vector<double> outflow;  ///< length × Q of each site [m³/s]
  std::vector<double> slope;    ///< length × ∂Q/∂η of each site [m²/s]
};

/// Evaluates the suction at all sites, with η per film dof [m] and λ per border unknown [m²], all positive.
void evaluate_suction(std::span<const SuctionSite> sites, std::span<const double> eta,
                      std::span<const double> lambda, const state::Materials& materials, Suction& suction);

/// Adds to the borders what their films lose [m³/s per border unknown].
/// Paper: Sec. 3.3.4, Eq. (17).
///   S = Σ over the three films of Q, lumped at the vertices: each site gives its length times Q
void add_border_source(std::span<const SuctionSite> sites, std::span<const double> outflow,
                       std::span<double> border_rate);

}  // namespace spume::drainage
