#pragma once

#include <vector>

#include "spume/state/film_network.hpp"
#include "spume/state/thin_point.hpp"

namespace spume::drainage::testing {

/// Small networks for drainage tests. η and λ are uniform and k = 0 unless said otherwise; lengths in m.
state::FilmNetwork make_network(mesh::FilmMesh mesh, double eta, double lambda);

/// A flat square film [0, side]² without borders, n × n cells, each cut in two right triangles. Its outline
/// has the natural condition of the elements: nothing flows out.
state::FilmNetwork square_film(double side, int n, double eta);

/// A sphere from an octahedron whose triangles were split in four `levels` times: one closed film around
/// phase 1.
state::FilmNetwork single_bubble(double radius, int levels, double eta);

/// Two bubbles: a flat septum and two paraboloid caps on one ring of `radius` in the plane x = 0. `rings` are
/// the relative radii of the rings of vertices, increasing to 1. One closed border, no junction.
state::FilmNetwork double_bubble(double radius, const std::vector<double>& rings, int n_sectors, double eta,
                                 double lambda);

/// Three flat strips that meet at 120° on one straight border along z. `distances` from the border increase
/// from 0; the far edges let nothing through, like the middle of a film. One cell of length `length` along
/// the border.
state::FilmNetwork three_strips(const std::vector<double>& distances, double length, double eta,
                                double lambda);

/// Six flat triangular films that meet at the centre of a regular tetrahedron, cut at the `distances` of its
/// four borders from the centre, increasing: four borders, one junction, one triangle in each film corner.
state::FilmNetwork tetrahedral_corner(const std::vector<double>& distances, double eta, double lambda);

/// n numbers q, q², … increasing from `first` to 1 in equal ratios.
std::vector<double> geometric(double first, int n);

/// The thinnest film dof of all.
state::ThinPoint thinnest_node(const state::FilmNetwork& network);

}  // namespace spume::drainage::testing
