#pragma once

#include <vector>

#include "spume/interface/potentials.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::interface {

/// Whether films are made of pieces as large as cubes where they can, or of those in tetrahedra everywhere.
enum class Pieces { OfCubes, OfTetrahedra };

/// The Voronoi interface of the potentials, linear in each tetrahedron of the Kuhn division of the cubes
/// between cell centres: the film of phases i and j is {ψ_i = ψ_j}, clipped by ψ_i ≥ ψ_k for every other
/// phase k.
///
/// With Pieces::OfCubes, where only two phases compete in a cube and no face has its corners alternately in
/// one and the other, its film is a closed line on the faces of the cube, filled; on faces between such cubes
/// the line goes straight from edge to edge of the cube. That is a third of the triangles.
///
/// The mesh is conforming by construction: a vertex is known by the face of the tetrahedra it lies in (its
/// lowest lattice point and the chain of steps to the others) and by the phases that meet there, never by
/// where it is. It lies on two sides of its film's polygon, each of which is either in a face of the
/// tetrahedron or a clipping phase, and these give that key. Orientation follows from the order of the
/// tetrahedron's corners. Polygons are cut into triangles by their shortest diagonals.
///
/// `winner` is as of find_winners(), the same on every rank as the potentials. Phases that one winner beats
/// at all corners of a cube are left out; a phase may win inside a tetrahedron without winning at a corner.
/// Throws NumericalError where more than 24 phases compete in a cube. Collective: each rank does some layers
/// of cubes, and gets the whole mesh, the same as one rank would make; a failure of one is one of all.
mesh::FilmMesh contour(const parallel::Communicator& ranks, const PhasePotentials& potentials,
                       const std::vector<mesh::Phase>& winner, Pieces pieces = Pieces::OfCubes);

}  // namespace spume::interface
