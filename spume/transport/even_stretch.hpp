#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/state/film_liquid.hpp"

namespace spume::transport {

/// The liquid of films that moved from `from` to `to`, two states of one mesh with the given topology,
/// without a gas that would say how they stretched: every lamella stretches evenly, and so does every border
/// along itself. The half-thickness η of a lamella's dofs changes by one factor, which keeps the lamella's
/// liquid; likewise λ of a border's. A dof without area before takes its lamella's mean η; a lamella without
/// area after keeps the liquid of its dofs. Liquid left where it is, dof by dof, would grow thin wherever the
/// mesh happens to be drawn out, mostly where films grow. total() is kept to round-off, however often. Throws
/// NumericalError where a volume is not finite.
void stretch_evenly(const mesh::FilmMesh& from, const mesh::FilmMesh& to, const mesh::Topology& topology,
                    state::FilmLiquid& liquid);

}  // namespace spume::transport
