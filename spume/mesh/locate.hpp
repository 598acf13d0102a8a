#pragma once

#include <array>
#include <functional>
#include <vector>

#include "spume/mesh/film_mesh.hpp"

namespace spume::mesh {

/// A point on a triangle.
struct SurfacePoint {
  int triangle = -1;               ///< −1: none found
  std::array<double, 3> weight{};  ///< barycentric
  double distance = 0;             ///< from the query point [m]
};

/// Closest point on a triangle with corners a, b, c; gives the squared distance [m²].
double closest_point_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c,
                                 std::array<double, 3>& weight);

/// Bins the triangles of a mesh in cubes of edge `bin_size`, to find closest points. Keeps a reference to the
/// mesh, which must not move meanwhile. In a periodic box all images of the triangles count. A bin size that
/// would make more than 2²² bins is doubled until it does not.
class TriangleLocator {
 public:
  TriangleLocator(const FilmMesh& mesh, double bin_size);
  /// Closest point on the triangles that `accept` takes (all of them if it is empty), within `reach` [m],
  /// which may be infinite; the first of equals in triangle order.
  SurfacePoint closest(const Vec3& x, double reach, const std::function<bool(int triangle)>& accept) const;
  /// All triangles whose bins touch the cube around the ball, in increasing order, each once: every triangle
  /// within `radius` [m] of x, and some that are a little farther.
  std::vector<int> near(const Vec3& x, double radius) const;

 private:
  /// Betters `found` by triangles as they are stored.
  void search(const Vec3& x, const std::function<bool(int triangle)>& accept, double& best_squared,
              SurfacePoint& found) const;
  std::array<Vec3, 3> stored_corners(int t) const;

  const FilmMesh* mesh_;
  bool is_inside_ = false;  ///< every vertex is stored in the box
  double bin_size_, longest_edge_ = 0;
  Vec3 origin_;
  std::array<int, 3> n_bins_;
  std::vector<int> bin_offset_, bin_triangle_;
};

}  // namespace spume::mesh
