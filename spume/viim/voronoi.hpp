#pragma once

#include "spume/interface/potentials.hpp"
#include "spume/state/phases.hpp"
#include "spume/viim/distance_field.hpp"

namespace spume::viim {

/// The Voronoi reconstruction V_ε of the paper (Secs. 2.1.3 and 3.1) as potentials whose films are the
/// Voronoi interface. With d_i the signed distance (negative inside) to {φ = ε} in phase i, the core of the
/// phase,
///   ψ_i = ε − d_i:
/// the phase of a point is that of the closest core, and ½(ψ_i − ψ_j) = ½(d_j − d_i) vanishes where two are
/// equally far. `epsilon` [m].
///
/// Each core is contoured and its vertices are moved onto the tricubic interpolation of the phase's signed
/// function; from the closest point on that surface Newton's method goes to the closest point on the local
/// polynomial, and where it fails, at ridges, the first point stays. Phases without a cell of φ > ε have no
/// potential: see phases_without_core().
interface::PhasePotentials voronoi_potentials(const DistanceField& field, double epsilon);

/// Living phases that V_ε would make vanish: no cell of theirs has φ > ε.
std::vector<mesh::Phase> phases_without_core(const DistanceField& field, const state::Phases& phases,
                                             double epsilon);

}  // namespace spume::viim
