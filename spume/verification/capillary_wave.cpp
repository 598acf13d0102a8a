#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "spume/verification/foam_run.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

using grid::Boundary;
using std::numbers::pi;

constexpr double laplace = 3000;  // Tρλ/μ²

/// Amplitude of cos kx [m]: the projection (2/A) ∫ z cos kx dx dy over the film.
double amplitude(const mesh::FilmMesh& films, double k, double z) {
  double sum = 0, area = 0;
  for (int t = 0; t < films.n_triangles(); ++t) {
    const double a = std::abs(0.5 * mesh::doubled_area_normal(films, t).z);
    const auto& v = films.triangle[t].vertex;
    for (int c = 0; c < 3; ++c)
      sum += a / 3 * (films.position[v[c]].z - z) * std::cos(k * films.position[v[c]].x);
    area += a;
  }
  return 2 * sum / area;
}

/// Root mean square of a/a0 less the exact, to ω0 t = 25.
double wave_error(const parallel::Communicator& communicator, int cells) {
  const Units units = units_of_viscosity(1 / std::sqrt(laplace));  // R stands for the wave length λ
  const double length = units.radius, h = length / cells, k = 2 * pi / length;
  auto run_case = cube_case(units, cells, cells);
  const int across = 8;
  run_case.box = {{0, 0, 0},
                  {length, across * h, 3 * length},
                  {cells, across, 3 * cells},
                  {Boundary::Periodic, Boundary::Periodic, Boundary::Slip}};
  const double middle = 1.5 * length, start = 0.01 * length;
  FoamRun run(communicator, run_case, 1,
              [&](mesh::Phase phase, const Vec3& x) { return (phase == 0 ? -0.5 : 0.5) * (x.z - middle); });
  for (Vec3& x : run.foam().films.position) x.z = middle + start * std::cos(k * x.x);
  run.accept_volumes();
  run.forget_motion();

  const PlanarWave exact(k, units.materials());
  const double a0 = amplitude(run.foam().films, k, middle), end = 25 / exact.omega_0();
  double squares = 0;
  run.move_until(end, [&](const simulation::MotionStep& step) {
    const double a = amplitude(run.foam().films, k, middle);
    // Velocities live at half steps: the gas was at rest half a step before the films were where they start.
    const double since_rest = run.foam().time + 0.5 * step.limit.dt;
    squares += step.limit.dt * std::pow(a / a0 - exact.amplitude(since_rest), 2);
    return true;
  });
  return std::sqrt(squares / end);
}

}  // namespace

void capillary_wave(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note(
      "a wave of a hundredth of its length on a film between equal fluids, 2σρλ/μ² = 3000, to ω0 t = "
      "25; film on faces of the grid; set-up, norm and figures are those of Basilisk's test capwave.c "
      "(Popinet and Zaleski 1999), in a box three wavelengths high (as in Gerris) in place of two");
  double coarser = 0;
  for (const auto& [cells, limit] : {std::pair{8, 0.14}, {16, 0.025}, {32, 0.0065}, {64, 0.0025}}) {
    if (scale == Scale::Small && cells > 16) break;
    const double error = wave_error(communicator, cells);
    report.at_most(fmt::format("rms error of a/a0, {} cells a wave length", cells), error, limit,
                   "exact initial-value solution (Prosperetti 1981); Basilisk's figures");
    if (coarser > 0) report.told("order of convergence", std::log2(coarser / error), "second order", 2.0);
    coarser = error;
  }
}

}  // namespace spume::verification
