#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/rupture/criterion.hpp"
#include "spume/state/film_liquid.hpp"
#include "spume/state/phases.hpp"

namespace spume::rupture {

struct RuptureReport {
  mesh::Phase kept, gone;  ///< phase `gone` became part of `kept` (the outside, above a membrane too, or the
                           ///< lower id)
  int n_lamellae;          ///< all between the two phases go together
  double area;             ///< of them [m²]
  double liquid;           ///< that they held [m³]
  double to_borders;       ///< of that, given to Plateau borders [m³]
  double to_films;  ///< injected into films around the former borders, with what those borders held [m³]
  double sprayed;   ///< [m³]
};

/// Removes every lamella between the phases a and b and merges them (paper, Sec. 3.4 steps i–iii). The
/// result is again a conforming film mesh with its liquid, nothing lost; reconstruct next.
///   (i)  liquid of the torn lamellae goes to the borders around them, uniformly by length;
///   (ii) those borders are ridges in one film now: what they hold is injected into that film around each
///   edge's
///        midpoint with weights A (1 − r²/r0²)², r0 = `injection_radius` [m] (enlarged by 1.5 until enough
///        film is found);
///   (iii) the phases merge: target volumes add up; a bubble that opens to the outside becomes outside.
RuptureReport rupture(mesh::Phase a, mesh::Phase b, mesh::FilmMesh& films, state::FilmLiquid& liquid,
                      state::Phases& phases, Fate fate, double injection_radius);

}  // namespace spume::rupture
