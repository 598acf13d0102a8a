#pragma once

#include <cstdint>
#include <vector>

#include "spume/base/vec3.hpp"
#include "spume/grid/box.hpp"

namespace spume::simulation {

/// Bubbles that fill a periodic box and leave no outside. Key section [foam.lattice].
struct LatticeShape {
  enum class Structure {
    Kelvin,        ///< body-centred cubic: 2 bubbles a cubic cell, 14 faces each
    WeairePhelan,  ///< A15: 8 bubbles a cubic cell, 2 with 12 faces and 6 with 14
    Random,        ///< seeded points, spread out by moving them to the centroids of their cells
  } structure = Structure::Kelvin;
  int cells = 2;           ///< of a crystal: cubic cells along the shortest side of the box
  int count = 27;          ///< of a random foam: bubbles
  double spread = 0;       ///< of a random foam: relative standard deviation of the diameters
  std::uint64_t seed = 1;  ///< of a random foam
};

/// A bubble of a lattice: its cell of the power diagram is where weight − |x − centre|², x by its nearest
/// image, is the largest.
struct LatticeBubble {
  Vec3 center;    ///< [m]
  double weight;  ///< [m²]
  double volume;  ///< that it shall have [m³]; those of all bubbles fill the box
};

/// Cubic cells of a crystal along x, y, z [−]; whole numbers where the crystal fits the box.
Vec3 crystal_cells(const LatticeShape& lattice, const grid::Box& box);
int count_bubbles(const LatticeShape& lattice, const grid::Box& box);

/// The bubbles of a lattice in a box that is periodic in all directions. Crystals are moved by a part of a
/// grid cell off the symmetries of the grid. Bubbles of a crystal have equal volumes. Those of a random foam
/// have diameters of a normal distribution, cut at two standard deviations; points are added one by one, not
/// too near to each other, and moved to the centroids of their cells ten times, while the weights give the
/// cells their volumes, to 2 % of the mean volume. Deterministic.
std::vector<LatticeBubble> make_lattice(const LatticeShape& lattice, const grid::Box& box);

/// Edge of the cube that a bubble of mean volume fills [m].
double lattice_spacing(const LatticeShape& lattice, const grid::Box& box);

/// Potential of one bubble at x, of the size of a distance [m], whose ties are the faces of the power
/// diagram; near a face between bubbles about `spacing` apart half the difference is the distance to it.
double lattice_potential(const LatticeBubble& bubble, const Vec3& x, const Domain& domain, double spacing);

}  // namespace spume::simulation
