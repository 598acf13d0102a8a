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
/// kernel, δ(r) = Π_d M(r_d/h)/h, M the cubic B-spline: ⅔ − s² + ½|s|³ for |s| ≤ 1, (2 − |s|)³/6 for 1 ≤ |s|
/// ≤
/// 2. They are adjoint, so work done by spread forces equals the work that the sampled velocity does on the
/// points. Points are the same on every rank; each rank handles the part of the kernels over its slab.
///
/// Why a spline: it samples linear fields exactly. A kernel that does not, as the cosine of half-width 1.5 h
/// does not, gives vertices velocities that waver from cell to cell by some hundredths of h times the
/// gradient; films then have a stiffness of their mesh's making. Its width is made up for by
/// grid::Sharpening; see docs/decisions/0013.
struct KernelCoupling {
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
