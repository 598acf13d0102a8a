#pragma once

#include "spume/mesh/topology.hpp"
#include "spume/simulation/case.hpp"
#include "spume/state/film_frame.hpp"
#include "spume/state/film_liquid.hpp"
#include "spume/state/film_network.hpp"

namespace spume::simulation {

/// Films that somebody else made, with their liquid.
struct SourcedFilms {
  mesh::FilmMesh films;
  mesh::Topology topology;
  state::FilmLiquid liquid;
  /// Edges of a single triangle: there a film ends, and nothing flows through.
  int n_free_edges = 0;
};

/// Makes one conforming mesh of a frame: points of the same coordinates are one vertex. Where `with_liquid`,
/// η and λ are those of the frame, else `half_thickness` [m] and `border_area` [m²] everywhere.
/// Throws InputError, with the place, where a triangle has no area or no two phases, or a phase of a larger
/// number than there are triangles; where more than twelve phases meet; where an edge is neither inside a
/// film, nor where a film ends, nor a Plateau border of three films between three phases; where points that
/// should be one differ by rounding: a poly-line without a border, or two ends of films within 1e-6 of an
/// edge; where η or λ is missing or not positive.
SourcedFilms join_films(const state::FilmFrame& frame, bool with_liquid, double half_thickness,
                        double border_area);

/// Reads the films of a file as join_films(); messages begin with the name of the file.
SourcedFilms load_films(const FilmsSource& source, double half_thickness, double border_area);

/// Volumes of the phases [m³], the outside 0; that of the sphere with the area of its films for a phase that
/// they do not enclose.
std::vector<double> volumes_of(const mesh::FilmMesh& films);

/// η and λ on a mesh of films: thickness from the liquid of each dof, k = k₁² + k₂² from the mesh. Together
/// with drainage::drain() this drains any film mesh, without a grid.
state::FilmNetwork network_of(const mesh::FilmMesh& films, const state::FilmLiquid& liquid);

}  // namespace spume::simulation
