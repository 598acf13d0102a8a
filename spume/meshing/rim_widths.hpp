#pragma once

#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::meshing {

/// For each border, at each of its vertices in their order along it: the width of the narrowest of the three
/// films there [m], or `largest` where all are wider. The width is the distance to the nearest point of the
/// film's rim that is at least 2.5 times farther along the rim than straight across, which leaves out what
/// lies around corners of more than 47 degrees.
std::vector<std::vector<double>> rim_widths(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                            double largest);

/// Length of each border from its first vertex to each of the others [m].
std::vector<std::vector<double>> arc_lengths(const mesh::FilmMesh& films, const mesh::Topology& topology);

}  // namespace spume::meshing
