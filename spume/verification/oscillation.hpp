#pragma once

#include "spume/parallel/communicator.hpp"
#include "spume/verification/exact_waves.hpp"

namespace spume::verification {

/// A bubble of radius R in a periodic box that starts from rest with mode n of relative amplitude
/// 0.02, in units ρ = 2σ = R = 1.
struct OscillationSetting {
  int mode;
  double viscosity;
  int cells_per_radius = 8;
  double amplitude = 0.02;  ///< at the start, over R
  double periods = 2.5;
  int box_radii = 5;          ///< width of the box over R
  int reconstruct_every = 0;  ///< steps; 0: as the program would
};

struct Oscillation {
  /// Of the amplitude, from one period on, when the layer around the film has formed.
  Decay fit;
  /// Largest rise of film and kinetic energy from one period to the next, over their fall in all periods.
  double growth;
  int n_reconstructions;
};

/// The same fit to the exact solution from rest in gas without end, at times spaced evenly. At μ = 0.05 its ω
/// is 0.2 % and its γ 0.5 to 0.7 % (modes 4 to 2) below those of the normal mode, at μ = 0.01 0.04 % and 0.2
/// %: from rest the film keeps a slow part beside its mode. As far as BubbleWave is exact, which 2.5 periods
/// are.
Decay fit_exact(const OscillationSetting& setting);

/// Collective.
Oscillation oscillate(const parallel::Communicator& communicator, const OscillationSetting& setting);

/// Thickness of the layer that a mode stirs, sqrt(2ν/ω), in cells.
double stokes_layer_cells(const OscillationSetting& setting);

}  // namespace spume::verification
