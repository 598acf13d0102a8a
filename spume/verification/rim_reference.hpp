#pragma once

#include <span>
#include <vector>

#include "spume/state/materials.hpp"

namespace spume::verification {

/// A flat film between a border and its middle, one-dimensional and without gravity:
///   η_t + (σ/3μ) (η³ η_xxx)_x = 0,   η_x = 0 at both ends,
///   (σ/3μ) η³ η_xxx = −½ Q(η, λ) at the border x = 0, nothing at the middle.
struct FlatFilm {
  double half_width;      ///< [m]
  double half_thickness;  ///< η at the start [m]
  double border_area;     ///< λ, held [m²]
};

/// η at the border at `times` [s], increasing. A discretisation of its own: finite volumes about cell
/// centres, from `finest` [m] at the border growing by 4 % a cell, mobility (a + b)(a² + b²)/4, extrapolated
/// linearly implicit Euler steps with the difference of one step and two halves as error.
std::vector<double> rim_of_flat_film(const FlatFilm& film, const state::Materials& materials, double finest,
                                     std::span<const double> times);

}  // namespace spume::verification
