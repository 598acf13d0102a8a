#pragma once

#include <array>
#include <vector>

#include "spume/base/vec3.hpp"
#include "spume/mesh/phase_set.hpp"

namespace spume::state {

/// The films at one instant as pictures and files of the series films.pvd see them. Film points are
/// duplicated where lamellae meet (one point a film dof), because η differs there; Plateau borders have
/// points of their own.
struct FilmFrame {
  struct Triangle {
    std::array<int, 3> point;  ///< indices into film_point; the normal runs from phase_a into phase_b
    int lamella;
    mesh::Phase phase_a, phase_b;  ///< phase_a < phase_b
  };

  double time = 0;                     ///< [s]
  std::vector<Vec3> film_point;        ///< [m]
  std::vector<double> half_thickness;  ///< η per film point [m]
  std::vector<Triangle> triangle;
  std::vector<Vec3> border_point;   ///< [m]
  std::vector<double> border_area;  ///< cross-section λ per border point [m²]
  std::vector<std::vector<int>>
      border_line;  ///< per border, indices into border_point along it; a ring repeats its first
};

}  // namespace spume::state
