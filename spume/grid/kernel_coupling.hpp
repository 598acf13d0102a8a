#pragma once

#include <span>
#include <vector>

#include "spume/base/vec3.hpp"
#include "spume/grid/field.hpp"

namespace spume::grid {

/// Where the components of a vector field lie: all at the centres of cells, or component c of cell (i, j, k)
/// at the middle of its lower face across axis c. The face beyond the last cell is that of the next period,
/// or a wall, where the component is zero.
enum class Placement { Centres, Faces };

/// The pair of operators that couples points of the film mesh to the grid: spreading and sampling with one
/// kernel δ − a h² Δ_h δ, where δ(r) = Π_d (1 + cos(π r_d/ζ))/(2ζ), |r_d| < ζ, is the tensor cosine and Δ_h
/// the 7-point Laplacian of the grid. They are adjoint, so work done by spread forces equals the work that
/// the sampled velocity does on the points. Points are the same on every rank; each rank handles the part of
/// the kernels over its slab.
///
/// Why −a h² Δ_h: a kernel without negative part smears forces and velocities by its second moment; with
/// a = ζ²/(2h²) (1/3 − 2/π²) + 1/8 = 0.272 that of kernel and mean of two cells together vanishes, and a = ¼
/// also makes up for the seven-point Laplacian of the projection. Linear theory of a plane film wave on the
/// grid then gives, at a Stokes layer of 3.6 cells, 0.3 % of frequency and 0.2 % of damping (plain: 1.0
/// and 4.5 %); see docs/decisions/0013.
struct KernelCoupling {
  double half_width_cells = 1.5;  ///< ζ/h, from 1 to 4; 2ζ/h an integer keeps the partition of unity
  double sharpening = 0.25;       ///< a; belongs to ζ = 1.5 h and values on faces
  Placement placement = Placement::Faces;

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
