#pragma once

#include <span>
#include <vector>

#include "spume/transport/liquid_mesh.hpp"

namespace spume::transport {

/// Puts `amount` [m³] onto the border dofs within `radius` [m] of x, weights length × (1 − r²/radius²)².
/// False, and nothing given, where less than 0.3 `h` of border (weighted) is there.
bool give_to_borders(const LiquidMesh& mesh, const Vec3& x, double amount, double radius, double h,
                     std::span<double> border_volume);

/// Puts `amount` [m³] onto the film dofs around x, weights area × (1 − r²/radius²)²; the radius grows by 1.5
/// until 0.3 h² of film (weighted) is found. Throws NumericalError when there is no film at all.
void give_to_films(const LiquidMesh& mesh, const Vec3& x, double amount, double radius, double h,
                   std::span<double> film_volume);

}  // namespace spume::transport
