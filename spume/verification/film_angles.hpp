#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::verification {

/// How far the angles of films and borders are from those of Plateau's laws [degrees].
struct PlateauAngles {
  double film_rms = 0, film_largest = 0;      ///< deviation of the angles between films at borders from 120
  double border_rms = 0, border_largest = 0;  ///< of those between borders at junctions from 109.471
  int n_film_angles = 0, n_border_angles = 0;
};

/// Measures all angles by fits: at each border vertex a quadric through the vertices of each film within
/// `reach` [m] that lie on no border, free to miss the point; at each junction a parabola from it along each
/// border's vertices within 1.5 `reach`. Border vertices within 1.5 `edge` [m] of a junction are passed over,
/// and films or borders with too few vertices for a fit. Deviations of which there are none are not numbers.
PlateauAngles plateau_angles(const mesh::FilmMesh& films, const mesh::Topology& topology, double reach,
                             double edge);

}  // namespace spume::verification
