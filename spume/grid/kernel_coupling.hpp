#pragma once

#include <span>
#include <vector>

#include "spume/base/vec3.hpp"
#include "spume/grid/field.hpp"

namespace spume::grid {

/// The pair of operators that couples points of the film mesh to the grid: spreading and sampling with one
/// kernel, the tensor cosine δ(r) = Π_d (1 + cos(π r_d/ζ))/(2ζ), |r_d| < ζ. They are adjoint, so work done by
/// spread forces equals the work that the sampled velocity does on the points. Points are the same on every
/// rank; each rank handles the part of the kernels over its slab.
struct KernelCoupling {
  double half_width_cells = 1.5;  ///< ζ/h, from 1 to 4; 2ζ/h an integer keeps the partition of unity

  /// density(x) += Σ_p F_p δ(x − x_p): a force [N] a point becomes a force density [N/m³]. Periodic images
  /// wrap; at walls the part of a kernel beyond the wall is reflected with the symmetry of the field.
  /// Collective in the sense that all ranks must call it; it does not communicate. The result does not depend
  /// on the number of ranks. Throws NumericalError when a point is not finite, or so far from the box that it
  /// was lost.
  void spread(std::span<const Vec3> points, std::span<const Vec3> forces, VectorField& density) const;
  /// velocity_p = h³ Σ_cells u δ(x − x_p). Collective. The result is bitwise the same on every rank and on
  /// any number of ranks, as far as u is. Throws NumericalError as spread() does.
  void sample(const VectorField& u, std::span<const Vec3> points, std::vector<Vec3>& velocities) const;
};

}  // namespace spume::grid
