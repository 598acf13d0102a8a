#pragma once

#include <functional>
#include <span>
#include <vector>

#include "spume/base/vec3.hpp"

namespace spume::drainage {

/// k and g_s of a lamella at given points.
struct LevelSetGeometry {
  std::vector<double> curvature_squared;  ///< k = k₁² + k₂² [1/m²]
  std::vector<Vec3> tangential_gravity;   ///< g_s [m/s²]
};

/// k and g_s as the paper has them (Sec. 3.3.2, "Additional comments"): from a function ψ that is zero on the
/// lamella, at the points of a grid through the origin, then trilinearly interpolated to the points.
///   n = ∇ψ/|∇ψ|,   k = tr((∇n)²),   g_s = g − (g·n) n,   ∇ by central differences over two spacings
/// Second order in the spacing. Takes: ψ of any unit, smooth and with a gradient within three spacings of the
/// points; positions and spacing [m]. The surface's own meaning of k needs points on it: off it, k is that of
/// the level set through the point.
LevelSetGeometry geometry_of_level_set(const std::function<double(const Vec3&)>& psi, double spacing,
                                       const Vec3& gravity, std::span<const Vec3> points);

}  // namespace spume::drainage
