#pragma once

#include <span>
#include <vector>

#include "spume/base/vec3.hpp"
#include "spume/grid/field.hpp"

namespace spume::grid {

/// The pair of operators that couples points of the film mesh to the grid: spreading and sampling with one
/// kernel δ − a h² Δ_h δ, where δ(r) = Π_d (1 + cos(π r_d/ζ))/(2ζ), |r_d| < ζ, is the tensor cosine and Δ_h
/// the 7-point Laplacian of the grid. They are adjoint, so work done by spread forces equals the work that
/// the sampled velocity does on the points. Points are the same on every rank; each rank handles the part of
/// the kernels over its slab.
///
/// Why −a h² Δ_h: across a film the pressure of a wave exp(ikx) falls off as exp(−k|z|), with a crest that
/// any positive kernel K cuts off. Spread and sampled, the force moves the film by
///   (1/π) ∫ k/(k² + q²) |K̂(k, q)|² dq = 1 − (k/π) ∫ (1 − |K̂(0, q)|²)/q² dq + O(k²h²)
/// of what it should, 0.76 at 16 cells a wavelength for the plain cosine of 1.5 h: a frequency 13 % too low.
/// `sharpening` is the a that makes the integral vanish: 0.9991 at 16 cells, 0.979 at 8.
struct KernelCoupling {
  double half_width_cells = 1.5;  ///< ζ/h, from 1 to 4; 2ζ/h an integer keeps the partition of unity
  double sharpening = 0.304902;   ///< a; belongs to ζ = 1.5 h (h: 0.157500, 2 h: 0.508678)

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
