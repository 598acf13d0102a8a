#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "spume/drainage/lamella.hpp"
#include "spume/drainage/lamella_shares.hpp"
#include "spume/drainage/plateau_border.hpp"
#include "spume/drainage/suction.hpp"
#include "spume/fem/lagged_lu.hpp"
#include "spume/fem/network_lu.hpp"
#include "spume/parallel/communicator.hpp"
#include "spume/state/film_network.hpp"
#include "spume/state/materials.hpp"

namespace spume::drainage {

/// One number per film dof and one per border unknown: η [m] and λ [m²], or their changes and balances.
struct Unknowns {
  std::vector<double> film, border;
};

/// The coupled drainage equations of a network, M y' = F(y), and their linearisation. M is the diagonal of
/// lumped areas and lengths. The matrix J drops ∂Q/∂λ in films and borders alike, so that (2, 1)ᵀ J = 0 still
/// holds: the ledger is kept to round-off, and each lamella has a matrix of its own, with λ lagged in it.
/// The ranks share the lamellae; all of them must have the same network and make the same calls. A lamella is
/// treated in the same way wherever that is, so that results have the same bits on any number of ranks.
class DrainageEquations {
 public:
  /// Throws NumericalError, with the place, where a triangle, film dof or border edge has no size.
  /// Collective.
  DrainageEquations(const state::FilmNetwork& network, const state::Materials& materials,
                    const parallel::Communicator& communicator = parallel::Communicator::self());

  /// Borders by themselves, without films, on this rank alone.
  DrainageEquations(BorderNetwork borders, const state::Materials& materials);

  const LamellaShares& shares() const { return shares_; }

  /// η and λ of the network, in the order of Unknowns, and back.
  Unknowns read(const state::FilmNetwork& network) const;
  void write(const Unknowns& y, state::FilmNetwork& network) const;

  const BorderNetwork& borders() const { return borders_; }
  std::span<const SuctionSite> sites() const { return sites_; }
  /// m of each film dof [m²], m^b of each border unknown [m].
  std::span<const double> film_area() const { return film_area_; }
  std::span<const double> border_length() const { return borders_.length; }
  /// The ledger 2Σ∫η dA + Σ∫λ dℓ [m³].
  double liquid(const Unknowns& y) const;

  /// F(y): film rows m η', border rows m^b λ' [m³/s]. Takes η, λ > 0. Film rows of lamellae of other ranks
  /// are zero.
  void rates(const Unknowns& y, Unknowns& rate);

  /// The same rates, and J at y.
  void linearise(const Unknowns& y, Unknowns& rate);
  /// Makes ready to solve with M − s J, s [s], of the last linearise(); matrices of lamellae are factorised
  /// only where that is due (fem::LaggedLu). False if that failed on some rank. Collective.
  bool factorise(double s);
  /// Replaces b by the solution of (M − s J) k = b: all lamellae, then the borders with what those films
  /// lose. Takes the film rows of own lamellae, gives all of them to every rank. Not finite in a lamella
  /// whose matrix turns out to be singular. Collective.
  void solve(Unknowns& b);

 private:
  struct LamellaSystem {
    LamellaDomain domain;
    LamellaJacobian jacobian;
    fem::LaggedLu lu;
    std::vector<double> weight;                   ///< 1/m of the local unknowns [1/m²]
    std::vector<double> eta, potential, balance;  ///< of the local unknowns
  };
  void gather(const Unknowns& y, LamellaSystem& lamella) const;
  /// Leaves η and the potential with the lamellae.
  void evaluate_film_rates(const Unknowns& y, const Suction& suction, Unknowns& rate);
  bool factorise_lamella(LamellaSystem& lamella);
  void solve_lamella(LamellaSystem& lamella, Unknowns& b) const;
  void solve_borders(Unknowns& b);
  void build_border_system();
  bool factorise_borders(double s);

  state::Materials materials_;
  LamellaShares shares_;
  BorderNetwork borders_;
  std::vector<SuctionSite> sites_;
  std::vector<double> film_area_;
  std::vector<LamellaSystem> lamellae_;  ///< of this rank
  std::vector<BorderRoot> border_root_;
  std::vector<std::array<double, 2>> border_slope_;     ///< of the flux along each edge, by its two ends
  std::vector<double> border_diagonal_;                 ///< of the matrix of the borders
  std::vector<std::array<double, 2>> border_coupling_;  ///< its entries 01 and 10 for each edge
  std::optional<fem::NetworkLu> border_lu_;             ///< none if there are no borders
  double total_border_length_ = 0;
  Suction suction_;  ///< of the last rates()
  Suction linearised_suction_;
  double s_ = 0;                ///< of the last factorise()
  std::vector<double> matrix_;  ///< values of one matrix before its factorisation
};

}  // namespace spume::drainage
