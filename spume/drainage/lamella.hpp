#pragma once

#include <span>
#include <vector>

#include "spume/drainage/suction.hpp"
#include "spume/fem/surface_laplacian.hpp"
#include "spume/state/film_network.hpp"
#include "spume/state/materials.hpp"

namespace spume::drainage {

/// Where the rim of a lamella touches a border: its local unknown and its suction site.
struct RimNode {
  int unknown, site;
};

/// One lamella with local unknowns 0, 1, …: what its drainage equation needs besides η.
struct LamellaDomain {
  std::vector<int> film_dof;              ///< of each local unknown, increasing
  fem::SurfaceLaplacian surface;          ///< m and K
  std::vector<double> curvature_squared;  ///< k = k₁² + k₂² [1/m²]
  std::vector<double> descent;            ///< g·(x − x₀), x₀ one vertex of the lamella [m²/s²]
  std::vector<RimNode> rim;

  int size() const { return static_cast<int>(film_dof.size()); }
};

/// Cuts the lamellae of the given numbers, increasing, out of the network.
/// Throws NumericalError, with the place, where a triangle or a film dof of theirs has no area.
std::vector<LamellaDomain> build_lamella_domains(const state::FilmNetwork& network, const Vec3& gravity,
                                                 std::span<const SuctionSite> sites,
                                                 const std::vector<int>& lamellae);

/// Mobility of the edge between half-thicknesses a and b: 2a²b²/(a + b) [m³], which is a³ for a = b and
/// vanishes with either. A mean of a³ and b³ would let a node lose liquid to a still thinner neighbour until
/// it is empty.
struct EdgeMobility {
  double value;
  double slope_a, slope_b;  ///< derivatives [m²]
};
EdgeMobility edge_mobility(double a, double b);

/// The potential that drives liquid in a lamella, w [1/s], at its nodes. Gravity enters as a potential of
/// position, so that a hydrostatic film, w constant, is exactly at rest.
///   w = (σ/3μ)(kη − (Kη)/m) + (ρ/3μ) g·x
void lamella_potential(const LamellaDomain& lamella, std::span<const double> eta,
                       const state::Materials& materials, std::span<double> potential);

/// Adds to the balance of each node, m η', what flows in along the edges of the lamella [m³/s].
/// Paper: Sec. 2.3.1, Eq. (3).
///   m_i η_i' = Σ_j K_ij M(η_i, η_j) (w_j − w_i),   the weak form of η_t + ∇_s·(η³ ∇_s w) = 0
/// Takes: η [m] > 0 and its potential, one per local unknown. Conserves Σ m η to round-off, since each edge
/// gives to one end what it takes from the other.
void add_lamella_flow(const LamellaDomain& lamella, std::span<const double> eta,
                      std::span<const double> potential, std::span<double> rate);

/// Takes the suction of the borders out of the rim nodes: each of the two faces of the film gives half of it.
/// Paper: Sec. 2.3.1, Eq. (4).
///   Q·ν = ½ Q(η, λ) on the boundary, lumped; ∂η/∂ν = 0 is the natural condition of K
/// Takes: `outflow` of all suction sites [m³/s].
void add_boundary_outflow(const LamellaDomain& lamella, std::span<const double> outflow,
                          std::span<double> rate);

/// Derivative of the rates of one lamella by its η, λ held: columns of the sparse matrix J [m²/s]. Two nodes
/// are coupled if they have a common neighbour.
class LamellaJacobian {
 public:
  explicit LamellaJacobian(const LamellaDomain& lamella);

  /// Fills value() for this η [m] and its potential; `slope` is ∂(outflow)/∂η of all suction sites [m²/s].
  void evaluate(const LamellaDomain& lamella, std::span<const double> eta, std::span<const double> potential,
                const state::Materials& materials, std::span<const double> slope);

  std::span<const int> column_offset() const { return column_offset_; }
  std::span<const int> row() const { return row_; }
  std::span<const int> diagonal() const { return diagonal_; }  ///< where J_jj is in value()
  std::span<const double> value() const { return value_; }

 private:
  void evaluate_edges(const LamellaDomain& lamella, std::span<const double> eta,
                      std::span<const double> potential);
  void add_column_of_potential(const LamellaDomain& lamella, int node, double slope_of_potential);

  std::vector<int> column_offset_, row_, diagonal_;
  std::vector<double> value_;
  std::vector<double> conductance_;  ///< K_ij M_ij of each entry of the surface's rows
  std::vector<double> edge_slope_;   ///< ∂/∂η_i of the flow from i's neighbour j into i, potential held
  std::vector<double> work_;         ///< one column, dense
};

}  // namespace spume::drainage
