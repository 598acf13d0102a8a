#include "spume/fem/triangle_matrices.hpp"

namespace spume::fem {

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * norm(cross(b - a, c - a));
}

TriangleMatrix triangle_stiffness(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Vec3, 3> x = {a, b, c};
  const double doubled_area = norm(cross(b - a, c - a));
  TriangleMatrix k{};
  for (int opposite = 0; opposite < 3; ++opposite) {
    const int i = (opposite + 1) % 3, j = (opposite + 2) % 3;
    const double half_cotangent = 0.5 * dot(x[i] - x[opposite], x[j] - x[opposite]) / doubled_area;
    k[i][j] = k[j][i] = -half_cotangent;
    k[i][i] += half_cotangent;
    k[j][j] += half_cotangent;
  }
  return k;
}

TriangleMatrix triangle_mass(double area) {
  const double off = area / 12, on = area / 6;
  return {{{on, off, off}, {off, on, off}, {off, off, on}}};
}

double lumped_triangle_mass(double area) {
  return area / 3;
}

double segment_length(const Vec3& a, const Vec3& b) {
  return norm(b - a);
}

SegmentMatrix segment_stiffness(double length) {
  const double k = 1 / length;
  return {{{k, -k}, {-k, k}}};
}

SegmentMatrix segment_mass(double length) {
  return {{{length / 3, length / 6}, {length / 6, length / 3}}};
}

double lumped_segment_mass(double length) {
  return length / 2;
}

}  // namespace spume::fem
