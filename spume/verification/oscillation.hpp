#pragma once

#include "spume/parallel/communicator.hpp"
#include "spume/verification/exact_waves.hpp"

namespace spume::verification {

/// A bubble of radius R in a periodic box that starts from rest with mode n of relative amplitude
/// 0.02, in units ρ = 2σ = R = 1.
struct OscillationSetting {
  int mode;
  double viscosity;
  int cells_per_radius;
  double amplitude = 0.02;  ///< at the start, over R
  double periods = 2.5;
  int box_radii = 5;          ///< width of the box over R
  int reconstruct_every = 0;  ///< steps; 0: as the program would
};

struct Oscillation {
  /// Of the amplitude, from one period on: there the exact solution that starts from rest is within 0.04 %
  /// (ω) and 1 % (γ) of its normal mode.
  Decay fit;
  /// Largest rise of film and kinetic energy from one period to the next, over their fall in all periods.
  double growth;
  int n_reconstructions;
};

/// Collective.
Oscillation oscillate(const parallel::Communicator& communicator, const OscillationSetting& setting);

/// Thickness of the layer that a mode stirs, sqrt(2ν/ω), in cells.
double stokes_layer_cells(const OscillationSetting& setting);

}  // namespace spume::verification
