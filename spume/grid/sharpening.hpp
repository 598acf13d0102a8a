#pragma once

#include "spume/grid/field.hpp"
#include "spume/grid/kernel_coupling.hpp"
#include "spume/grid/layer_window.hpp"

namespace spume::grid {

/// Makes up for the width of the kernel that couples films and grid: S = 1 + aλ + bλ², λ = −h² Δ_h with the
/// 7-point Laplacian Δ_h. What was spread is sharpened before the gas feels it, and the velocity of the gas
/// before it is sampled; S is symmetric, so the pair of operators stays adjoint, and away from no-slip walls
/// it leaves a velocity on faces as free of divergence as it was.
///
/// With a = 1/8 spline (1 − θ²/6), S and the wide means between faces and cells (1 + θ²/24, see
/// flow/wide_mean.hpp) together are 1 + O(θ⁴) along an axis. b is chosen: with it a film wave is near the
/// exact law from 8 to 64 cells a wavelength; see docs/decisions/0013.
class Sharpening {
 public:
  static constexpr double a = 0.125, b = 0.045;

  explicit Sharpening(const Grid& grid) : n_(grid.cells()), u_(grid, 1, 1), image_(grid) {}

  /// u ← S u, components continued across walls by their symmetry; one that lies on a wall's faces is
  /// zero there, before and after. Collective. The result is bitwise the same on any number of ranks.
  void apply(VectorField& u, Placement placement = Placement::Faces);

 private:
  void apply(Field& u, int face_axis);
  void make_image(int k, int wall_axis);
  void finish(int k, int wall_axis, double* layer);

  Index3 n_;
  LayerWindow u_;
  LayerRing image_;  ///< a u + b λu
};

}  // namespace spume::grid
