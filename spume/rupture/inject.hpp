#pragma once

#include <optional>
#include <span>
#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::rupture {

/// A ball of liquid that collapses onto the films around it.
struct LiquidBall {
  Vec3 centre;
  double volume;                       ///< [m³]
  std::optional<mesh::Lamella> films;  ///< only onto films between these phases; any without
};

/// Collapses balls of liquid onto films (paper, Sec. 3.4 step ii): the film dofs within r0 = `radius` [m] of
/// the centre share the volume with weights A (1 − r²/r0²)², A the lumped area. Where that finds less than
/// 0.13 r0² of film (weighted; a whole disc has π r0²/3), r0 grows by 1.5. Gives the sum of the volumes [m³].
/// Throws NumericalError when the mesh has no film.
double inject(std::span<const LiquidBall> balls, const mesh::FilmMesh& films, const mesh::Topology& topology,
              double radius, std::span<double> lamella_volume);

}  // namespace spume::rupture
