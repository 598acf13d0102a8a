#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spume/verification/oscillation.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

const std::string from_rest = "the same fit to the exact solution from rest";

/// Gives the error of the frequency, relative.
double one(const parallel::Communicator& communicator, const OscillationSetting& setting, Report& report) {
  const Decay exact = fit_exact(setting);
  const Oscillation got = oscillate(communicator, setting);
  const std::string what =
      fmt::format("mode {}, μ = {}, R = {} h: ", setting.mode, setting.viscosity, setting.cells_per_radius);
  report.note(fmt::format("Stokes layer of {:.1f} cells; {} reconstructions", stokes_layer_cells(setting),
                          got.n_reconstructions));
  if (stokes_layer_cells(setting) >= 3) {
    report.relative(what + "ω", got.fit.omega, exact.omega, 0.01, from_rest);
    report.relative(what + "γ", got.fit.gamma, exact.gamma, 0.04, from_rest);
  } else {
    report.told(what + "ω", got.fit.omega, from_rest, exact.omega);
    report.told(what + "γ", got.fit.gamma, from_rest, exact.gamma);
  }
  return std::abs(got.fit.omega / exact.omega - 1);
}

/// The error of ω on the finer grid must be at most `share` of that on the coarser.
void converges(const parallel::Communicator& communicator, const OscillationSetting& setting, int coarse,
               int fine, double share, Report& report) {
  OscillationSetting on_coarse = setting, on_fine = setting;
  on_coarse.cells_per_radius = coarse;
  on_fine.cells_per_radius = fine;
  const double first = one(communicator, on_coarse, report), second = one(communicator, on_fine, report);
  report.at_most(
      fmt::format("mode {}, μ = {}: error of ω on the finer grid", setting.mode, setting.viscosity), second,
      share * first, fmt::format("{:.2f} of that on the coarser", share));
}

}  // namespace

void oscillating_bubble(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note(
      "ρ = 2σ = R = 1, box 5 R wide (modes 3, 4 of μ = 0.05: 4 R); frequency ω and damping γ by a fit "
      "from 1 to 2.5 periods");
  if (scale == Scale::Small) return converges(communicator, {.mode = 2, .viscosity = 0.05}, 6, 8, 1, report);
  // At least in proportion to h.
  converges(communicator, {.mode = 2, .viscosity = 0.05}, 8, 16, 1. / 2, report);
  // Their layers are thinner, which takes finer grids; the images of a bubble, which they feel less, may be
  // nearer.
  for (const int mode : {3, 4})
    converges(communicator, {.mode = mode, .viscosity = 0.05, .box_radii = 4}, 8, 24, 1. / 3, report);
  for (const int mode : {2, 3, 4})
    one(communicator, {.mode = mode, .viscosity = 0.01, .cells_per_radius = 16}, report);
  one(communicator, {.mode = 2, .viscosity = 0.001, .cells_per_radius = 16}, report);

  const Oscillation ten = oscillate(
      communicator, {.mode = 2, .viscosity = 0.001, .cells_per_radius = 8, .amplitude = 0.05, .periods = 10});
  report.at_most("mode 2, μ = 0.001, R = 8 h: rise of energy in 10 periods", ten.growth, 0.01,
                 "energy of the wave only falls");
}

void reconstruction_damping(const parallel::Communicator& communicator, Scale, Report& report) {
  report.note("mode 2 of a bubble, R = 8 h, La = 1e3, reconstructed at fixed intervals");
  const double viscosity = std::sqrt(2 / 1e3);
  const auto every = [&](int steps) {
    return oscillate(communicator,
                     {.mode = 2, .viscosity = viscosity, .cells_per_radius = 8, .reconstruct_every = steps});
  };
  const Oscillation never = every(1000000), rarely = every(20), often = every(5);
  const Decay exact = fit_exact({.mode = 2, .viscosity = viscosity});
  report.told("γ, never", never.fit.gamma, from_rest, exact.gamma);
  report.told(fmt::format("γ, every 20 steps ({} times)", rarely.n_reconstructions), rarely.fit.gamma,
              from_rest, exact.gamma);
  report.told(fmt::format("γ, every 5 steps ({} times)", often.n_reconstructions), often.fit.gamma, from_rest,
              exact.gamma);
  report.at_most("γ every 5 steps over γ every 20", often.fit.gamma / rarely.fit.gamma, 1.04,
                 "reconstruction is neutral");
  report.absolute("ω every 5 steps over ω every 20", often.fit.omega / rarely.fit.omega, 1, 0.01,
                  "reconstruction is neutral");
}

}  // namespace spume::verification
