#include "spume/drainage/level_set_geometry.hpp"

#include <array>
#include <cmath>

namespace spume::drainage {
namespace {

Vec3 unit(int axis) {
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}

}  // namespace

LevelSetGeometry geometry_of_level_set(const std::function<double(const Vec3&)>& psi, double spacing,
                                       const Vec3& gravity, std::span<const Vec3> points) {
  const auto normal = [&](const Vec3& x) {
    Vec3 gradient;
    for (int a = 0; a < 3; ++a)
      gradient[a] = psi(x + spacing * unit(a)) - psi(x - spacing * unit(a));  // its length does not matter
    return normalized(gradient);
  };
  const auto curvature_squared = [&](const Vec3& x) {
    std::array<Vec3, 3> change;  // ∂n/∂x_a
    for (int a = 0; a < 3; ++a)
      change[a] = (normal(x + spacing * unit(a)) - normal(x - spacing * unit(a))) / (2 * spacing);
    double trace = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) trace += change[a][b] * change[b][a];
    return trace;
  };
  LevelSetGeometry geometry;
  for (const Vec3& x : points) {
    std::array<double, 3> below{}, fraction{};  // the grid point below, in spacings, and how far above it
    for (int a = 0; a < 3; ++a) {
      below[a] = std::floor(x[a] / spacing);
      fraction[a] = x[a] / spacing - below[a];
    }
    double k = 0;
    Vec3 g_s{};
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      Vec3 place;
      for (int a = 0; a < 3; ++a) {
        const int above = corner >> a & 1;
        weight *= above == 1 ? fraction[a] : 1 - fraction[a];
        place[a] = spacing * (below[a] + above);
      }
      const Vec3 n = normal(place);
      k += weight * curvature_squared(place);
      g_s += weight * (gravity - dot(gravity, n) * n);
    }
    geometry.curvature_squared.push_back(k);
    geometry.tangential_gravity.push_back(g_s);
  }
  return geometry;
}

}  // namespace spume::drainage
