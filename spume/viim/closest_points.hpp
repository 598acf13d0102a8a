#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "spume/grid/box.hpp"
#include "spume/mesh/film_mesh.hpp"

namespace spume::viim {

/// The point of a triangulated surface that is closest to the centre of a cell.
struct ClosestPoint {
  std::size_t cell;  ///< i fastest, then j, k
  Vec3 centre;       ///< of the cell [m]
  int triangle;
  std::array<double, 3> weight;  ///< barycentric, in the triangle
  Vec3 point;                    ///< [m]
  double distance;               ///< from the centre [m]
};

/// Closest points of all cells within `reach` [m] of the surface, in the order of cells; of those with
/// `wanted` only, unless that is empty (one entry a cell). Cells around each
/// triangle try it; from there triangles pass from cell to neighbouring cell as long as they are closer than
/// what was found; at last every cell whose point lies on an edge walks over the triangles around it down to
/// the closest. Where two points are nearly equally far, either may be given.
std::vector<ClosestPoint> closest_points(const mesh::FilmMesh& surface, const grid::Box& box, double reach,
                                         const std::vector<bool>& wanted = {});

}  // namespace spume::viim
