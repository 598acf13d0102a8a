#pragma once

#include <array>
#include <functional>
#include <optional>

#include "spume/base/index3.hpp"
#include "spume/base/vec3.hpp"
#include "spume/grid/box.hpp"

namespace spume::viim {

/// The tricubic Lagrange polynomial of the cube between cell centres that holds a point, from its 4 × 4 × 4
/// cells.
class LocalCubic {
 public:
  using Values = std::function<double(int i, int j, int k)>;

  /// `value(i, j, k)` is asked for the 64 cells around `x` [m], which may lie beyond the box.
  LocalCubic(const grid::Box& box, const Vec3& x, const Values& value);

  struct Taylor {
    double value;   ///< [m]
    Vec3 gradient;  ///< [−]
    /// xx, yy, zz, xy, yz, zx [1/m]
    std::array<double, 6> hessian;
  };
  Taylor at(const Vec3& x) const;

  /// The point of {p = 0} closest to `x`, by Newton's method from `start` on the first-order conditions
  ///   y − x + λ ∇p(y) = 0,  p(y) = 0
  /// (Saye, Comm. App. Math. Comp. Sci. 9 (2014) 107, Sec. 3). Nothing when it does not converge to 1e-9 h,
  /// or leaves the ball of half a cell around `start`.
  std::optional<Vec3> closest_zero(const Vec3& x, const Vec3& start) const;

 private:
  Vec3 lower_;
  double h_;
  Index3 corner_;  ///< the lowest of the 64 cells
  std::array<double, 64> value_;
};

}  // namespace spume::viim
