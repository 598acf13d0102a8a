#pragma once

#include <array>

#include "spume/flow/block.hpp"
#include "spume/grid/elliptic.hpp"
#include "spume/grid/layer_window.hpp"

namespace spume::flow {

/// The projections of a step. All solve the seven-point Poisson problem at cell centres.
class Projection {
 public:
  Projection(const grid::Grid& grid, grid::EllipticSolver& elliptic);

  /// MAC projection: takes from velocities on faces the gradient that leaves every owned cell without
  /// divergence, to the accuracy of the elliptic solver. Collective.
  void clear_divergence(BlockVector& face_velocity);

  /// Approximate projection 𝒫 of the rate of change of the velocity, and the pressure that it takes.
  /// Collective.
  ///
  /// Paper: Sec. 3.2.1, Eq. (8).
  ///   (uⁿ⁺¹ − uⁿ)/Δt = 𝒫 x = x − Gψ/ρ,   ∇²_h ψ = ρ D x,   p^{n+½} = p^{n−½} + ψ,   x = (u* − uⁿ)/Δt
  ///
  /// D and G are centred differences at cell centres, of fourth order: faces take the wide_mean() of cells,
  /// and cells that of faces. D G is a wider Laplacian than ∇²_h, hence "approximate": of a gradient of phase
  /// advance θ over a cell along an axis, 𝒫 leaves the part 8q²/9 + 4q³/9 − q/3, q = sin²(θ/2), which is
  /// O(h²) on smooth fields and never below −0.03 or above 1.
  /// Differs from the paper: pressure at cell centres instead of nodes, so that one elliptic operator serves
  /// all.
  void project(double density, grid::VectorField& rate, grid::Field& pressure);

  /// 𝒫 of a velocity: u ← 𝒫 u. What projecting rates of change alone leaves behind would add up over the
  /// steps, since the divergence of uⁿ is in nothing that Eq. (8) sees; after this it is smaller by the
  /// factor above a step. Collective.
  void filter(grid::VectorField& velocity);

 private:
  void remove_gradient(grid::VectorField& x);

  const grid::Grid& grid_;
  grid::EllipticSolver& elliptic_;
  BlockLayout layout_;
  grid::Field potential_;  ///< whose gradient was removed last
  grid::LayerWindow phi_;  ///< on the potential
  std::array<grid::LayerWindow, 3> x_;
};

/// max |D u_face| [1/s] of the owned cells of all ranks. Collective.
double max_divergence(const grid::Grid& grid, const BlockVector& face_velocity);

}  // namespace spume::flow
