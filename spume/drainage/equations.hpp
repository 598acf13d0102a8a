#pragma once

#include <array>
#include <functional>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "spume/drainage/lamella.hpp"
#include "spume/drainage/plateau_border.hpp"
#include "spume/drainage/suction.hpp"
#include "spume/fem/sparse_lu.hpp"
#include "spume/state/film_network.hpp"
#include "spume/state/materials.hpp"

namespace spume::drainage {

/// One number per film dof and one per border unknown: η [m] and λ [m²], or their changes and balances.
struct Unknowns {
  std::vector<double> film, border;
};

/// Liquid that comes from elsewhere at a time [s]: adds to the balances of film dofs and border unknowns
/// [m³/s], of one face of the films.
using Forcing = std::function<void(double time, Unknowns& rate)>;

/// When a step of ROS2 from t takes the forcing, in units of Δt after t: γ in Stepper::start() and 1 − γ in
/// Stepper::attempt(). To the order of the scheme these are the terms F + γ Δt F_t and F(t + Δt) − γ Δt F_t
/// that it asks for where F depends on time.
inline constexpr double first_forcing = 1 - 1 / std::numbers::sqrt2, second_forcing = 1 / std::numbers::sqrt2;

/// The coupled drainage equations of a network, M y' = F(y), and their linearisation. M is the diagonal of
/// lumped areas and lengths. The matrix J drops ∂Q/∂λ in films and borders alike, so that (2, 1)ᵀ J = 0 still
/// holds: the ledger is kept to round-off, and each lamella has a matrix of its own, with λ lagged in it.
class DrainageEquations {
 public:
  /// Throws NumericalError, with the place, where a triangle, film dof or border edge has no size.
  DrainageEquations(const state::FilmNetwork& network, const state::Materials& materials);

  /// Borders by themselves, without films.
  DrainageEquations(BorderNetwork borders, const state::Materials& materials);

  /// Adds a forcing to the rates, taken at the time set last [s]; J does not know it.
  void force(Forcing forcing) { forcing_ = std::move(forcing); }
  void set_time(double time) { time_ = time; }

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

  /// F(y): film rows m η', border rows m^b λ' [m³/s]. Takes η, λ > 0.
  void rates(const Unknowns& y, Unknowns& rate);

  /// Evaluates J at y.
  void linearise(const Unknowns& y);
  /// Factorises M − s J, s [s], of the last linearise(). False if that failed.
  bool factorise(double s);
  /// Replaces b by the solution of (M − s J) k = b: all lamellae, then the borders with what those films
  /// lose.
  void solve(Unknowns& b);

 private:
  struct LamellaSystem {
    LamellaDomain domain;
    LamellaJacobian jacobian;
    fem::SparseLu lu;
    std::vector<double> eta, potential, balance;  ///< of the local unknowns
  };
  struct BorderSystem {
    std::vector<int> column_offset, row;
    std::vector<int> diagonal;                     ///< position of each J_ii
    std::vector<std::array<int, 2>> off_diagonal;  ///< of each link: position of J_01 and J_10
    std::vector<double> jacobian;
    std::vector<fem::SparseLu> lu;  ///< none if there are no borders
  };

  void gather(const Unknowns& y, LamellaSystem& lamella) const;
  void solve_lamella(LamellaSystem& lamella, Unknowns& b) const;
  void build_border_pattern();
  void linearise_borders(const Unknowns& y);
  bool factorise_borders(double s);

  state::Materials materials_;
  Forcing forcing_;
  double time_ = 0;
  BorderNetwork borders_;
  std::vector<SuctionSite> sites_;
  std::vector<double> film_area_;
  std::vector<LamellaSystem> lamellae_;
  BorderSystem border_system_;
  Suction suction_;  ///< of the last rates()
  Suction linearised_suction_;
  double s_ = 0;                ///< of the last factorise()
  std::vector<double> matrix_;  ///< values of one matrix before its factorisation
};

}  // namespace spume::drainage
