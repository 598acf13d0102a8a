#pragma once

#include <string>
#include <vector>

#include "spume/config/foam_estimate.hpp"
#include "spume/flow/navier_stokes.hpp"
#include "spume/simulation/case.hpp"

namespace spume::config {

/// What can be told about a case before it runs.
struct Assessment {
  double h;  ///< edge of a cell [m]
  double n_cells;
  int n_bubbles;
  double smallest_diameter;  ///< of a bubble, along its shortest axis [m]
  double mean_diameter;      ///< of the sphere of the same volume [m]
  std::vector<flow::StepLimit> step_limits;
  double laplace_number;  ///< of the gas in the mean bubble, 2σ ρ_g 2R / μ_g²
  FoamEstimate foam;
  double liquid_volume;     ///< in films and borders [m³]
  double liquid_fraction;   ///< liquid over gas in bubbles
  double border_radius;     ///< of the concave faces of a Plateau border, sqrt(λ / (√3 − π/2)) [m]
  double memory;            ///< of all ranks together [bytes]
  double seconds_per_step;  ///< of the gas and its films, on one core
  std::vector<std::string>
      warnings;  ///< where the case leaves the regime of the model, or the grid is too coarse
};

/// `bubbles`: all of them, from simulation::bubbles_of.
Assessment assess(const simulation::Case& run_case, const std::vector<simulation::BubbleShape>& bubbles);

/// The assessment as a page for a terminal; warnings last.
std::string report(const Assessment& assessment, const simulation::Case& run_case);

}  // namespace spume::config
