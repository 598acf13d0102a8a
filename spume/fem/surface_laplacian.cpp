#include "spume/fem/surface_laplacian.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "spume/base/error.hpp"
#include "spume/fem/triangle_matrices.hpp"

namespace spume::fem {
namespace {

struct Entry {
  int row, column;
  double value;
};

[[noreturn]] void fail_at(const char* what, const Vec3& x) {
  std::ostringstream message;
  message << what << " at (" << x.x << ", " << x.y << ", " << x.z << ") m";
  throw NumericalError(message.str());
}

/// Entries of one triangle off the diagonal; adds its area to the masses.
void add_triangle(std::span<const Vec3> position, const std::array<int, 3>& corner, const Domain& domain,
                  std::vector<double>& mass, std::vector<Entry>& entries) {
  const Vec3 a = position[corner[0]], b = domain.near(position[corner[1]], a),
             c = domain.near(position[corner[2]], a);
  const double area = triangle_area(a, b, c);
  const TriangleMatrix k = triangle_stiffness(a, b, c);
  for (int i = 0; i < 3; ++i) {
    mass[corner[i]] += lumped_triangle_mass(area);
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      if (!std::isfinite(k[i][j])) fail_at("a film triangle has no area", a);
      entries.push_back({corner[i], corner[j], k[i][j]});
    }
  }
}

}  // namespace

SurfaceLaplacian assemble_surface_laplacian(std::span<const Vec3> position,
                                            std::span<const std::array<int, 3>> triangle,
                                            const Domain& domain) {
  const int n = static_cast<int>(position.size());
  SurfaceLaplacian surface;
  surface.mass.assign(n, 0.0);
  std::vector<Entry> entries;
  entries.reserve(6 * triangle.size());
  for (const auto& corner : triangle) add_triangle(position, corner, domain, surface.mass, entries);
  for (int i = 0; i < n; ++i)
    if (!(surface.mass[i] > 0)) fail_at("a film vertex has no area", position[i]);

  // Stable, so that K_ij and K_ji add up the same triangles in the same order and are bitwise equal.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& p, const Entry& q) {
    return p.row != q.row ? p.row < q.row : p.column < q.column;
  });
  surface.offset.assign(n + 1, 0);
  for (std::size_t e = 0; e < entries.size(); ++e) {
    const Entry& entry = entries[e];
    if (e > 0 && entry.row == entries[e - 1].row && entry.column == entries[e - 1].column) {
      surface.stiffness.back() += entry.value;
      continue;
    }
    surface.neighbour.push_back(entry.column);
    surface.stiffness.push_back(entry.value);
    ++surface.offset[entry.row + 1];
  }
  for (int i = 0; i < n; ++i) surface.offset[i + 1] += surface.offset[i];
  return surface;
}

std::vector<int> second_ring(const SurfaceLaplacian& surface, int node) {
  std::vector<int> ring{node};
  for (int e = surface.offset[node]; e < surface.offset[node + 1]; ++e) {
    const int next = surface.neighbour[e];
    ring.push_back(next);
    for (int f = surface.offset[next]; f < surface.offset[next + 1]; ++f)
      ring.push_back(surface.neighbour[f]);
  }
  std::sort(ring.begin(), ring.end());
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

}  // namespace spume::fem
