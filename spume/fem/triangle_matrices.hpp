#pragma once

#include <array>

#include "spume/base/vec3.hpp"

namespace spume::fem {

/// Entry [i][j] belongs to the linear basis functions φ_i, φ_j of the corners i, j.
using TriangleMatrix = std::array<std::array<double, 3>, 3>;
using SegmentMatrix = std::array<std::array<double, 2>, 2>;

/// Area of the triangle abc [m²].
double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c);

/// Stiffness ∫ ∇φ_i·∇φ_j of the linear elements on the triangle abc, without unit: off the diagonal minus
/// half the cotangent of the angle opposite to the edge ij. Rows sum to zero. Not finite where the triangle
/// has no area.
TriangleMatrix triangle_stiffness(const Vec3& a, const Vec3& b, const Vec3& c);

/// Consistent mass ∫ φ_i φ_j of a triangle with this area [m²]: area/12 off the diagonal, area/6 on it.
TriangleMatrix triangle_mass(double area);

/// Lumped mass of each corner, the row sum of triangle_mass: area/3 [m²].
double lumped_triangle_mass(double area);

/// Length of the segment ab [m].
double segment_length(const Vec3& a, const Vec3& b);

/// Stiffness ∫ φ_i' φ_j' of a segment of this length: ±1/length [1/m].
SegmentMatrix segment_stiffness(double length);

/// Consistent mass ∫ φ_i φ_j of a segment of this length: length/6 off the diagonal, length/3 on it [m].
SegmentMatrix segment_mass(double length);

/// Lumped mass of each end, the row sum of segment_mass: length/2 [m].
double lumped_segment_mass(double length);

}  // namespace spume::fem
