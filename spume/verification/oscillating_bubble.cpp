#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spume/verification/oscillation.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

const std::string law = "exact viscous law of the mode";

/// Gives the error of the frequency, relative.
double one(const parallel::Communicator& communicator, const OscillationSetting& setting, Report& report) {
  const Decay exact = bubble_mode(setting.mode, 1, {1, setting.viscosity, 1});
  const Oscillation got = oscillate(communicator, setting);
  const std::string what =
      fmt::format("mode {}, μ = {}, R = {} h: ", setting.mode, setting.viscosity, setting.cells_per_radius);
  report.note(fmt::format("Stokes layer of {:.1f} cells; {} reconstructions", stokes_layer_cells(setting),
                          got.n_reconstructions));
  if (stokes_layer_cells(setting) >= 3) {
    report.relative(what + "ω", got.fit.omega, exact.omega, 0.01, law);
    report.relative(what + "γ", got.fit.gamma, exact.gamma, 0.04, law);
  } else {
    report.told(what + "ω", got.fit.omega, law, exact.omega);
    report.told(what + "γ", got.fit.gamma, law, exact.gamma);
  }
  return std::abs(got.fit.omega / exact.omega - 1);
}

}  // namespace

void oscillating_bubble(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("ρ = 2σ = R = 1, box 5 R wide; frequency ω and damping γ by a fit from 1 to 2.5 periods");
  const bool full = scale == Scale::Full;
  for (const int mode : full ? std::vector<int>{2, 3, 4} : std::vector<int>{2}) {
    const double coarse = one(communicator, {mode, 0.05, full ? 8 : 6}, report);
    const double fine = one(communicator, {mode, 0.05, full ? 16 : 8}, report);
    // The images of the bubble in a periodic box 5 R wide shift ω by some tenths of a per cent on every grid.
    constexpr double of_the_box = 0.003;
    report.at_most(fmt::format("mode {}, μ = 0.05: error of ω on the finer grid", mode), fine,
                   std::max(of_the_box, (full ? 0.5 : 1) * coarse), "half of that on the coarser, or 0.3 %");
  }
  if (!full) return;
  for (const int mode : {2, 3, 4}) one(communicator, {mode, 0.01, 16}, report);
  one(communicator, {2, 0.001, 16}, report);

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
  const Decay exact = bubble_mode(2, 1, {1, viscosity, 1});
  report.told("γ, never", never.fit.gamma, law, exact.gamma);
  report.told(fmt::format("γ, every 20 steps ({} times)", rarely.n_reconstructions), rarely.fit.gamma, law,
              exact.gamma);
  report.told(fmt::format("γ, every 5 steps ({} times)", often.n_reconstructions), often.fit.gamma, law,
              exact.gamma);
  report.at_most("γ every 5 steps over γ every 20", often.fit.gamma / rarely.fit.gamma, 1.04,
                 "reconstruction is neutral");
  report.absolute("ω every 5 steps over ω every 20", often.fit.omega / rarely.fit.omega, 1, 0.01,
                  "reconstruction is neutral");
}

}  // namespace spume::verification
