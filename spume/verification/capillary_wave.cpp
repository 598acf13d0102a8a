#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
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
  if (const char* f = std::getenv("CAPF")) run_case.rearrangement.capillary_factor = std::atof(f);
  if (const char* f = std::getenv("CAPDT")) run_case.rearrangement.capillary_factor = std::min(run_case.rearrangement.capillary_factor, std::atof(f) / std::sqrt(run_case.materials.gas.density * h * h * h / (2 * run_case.materials.film.surface_tension)) * std::sqrt(run_case.materials.gas.density * length * length * length / (2 * run_case.materials.film.surface_tension)) );
  if (std::getenv("NOREC")) { run_case.rearrangement.reconstruction_interval = 1000000; run_case.rearrangement.reconstruction_displacement = 100; }
  const int across = 8;
  run_case.box = {{0, 0, 0},
                  {length, across * h, 3 * length},
                  {cells, across, 3 * cells},
                  {Boundary::Periodic, Boundary::Periodic, Boundary::Slip}};
  const double middle = 1.5 * length + (std::getenv("SHIFT") ? std::atof(std::getenv("SHIFT")) * h : 0), start = 0.01 * length;
  FoamRun run(communicator, run_case, 1,
              [&](mesh::Phase phase, const Vec3& x) { return (phase == 0 ? -0.5 : 0.5) * (x.z - middle); });
  for (Vec3& x : run.foam().films.position) x.z = middle + start * std::cos(k * x.x);
  run.accept_volumes();
  run.forget_motion();

  if (std::getenv("RECTEST")) {
    for (double f : {1.0, 0.8, 0.6, 0.4, 0.2, -0.5, -1.0}) {
      for (Vec3& x : run.foam().films.position) x.z = middle + f * start * std::cos(k * x.x);
      run.accept_volumes();
      const double a = amplitude(run.foam().films, k, middle);
      run.forget_motion();
      run.reconstruct();
      const double b = amplitude(run.foam().films, k, middle);
      double worst = 0;
      for (Vec3& x : run.foam().films.position) worst = std::max(worst, std::abs(x.z - middle - f * start * std::cos(k * x.x)));
      fmt::print("{} cells f {}: amplitude {:.5f} h changes by {:.3e} h, relative to start {:.3e}; worst {:.4f} h\n", cells, f, a / h, (b - a) / h, (b - a) / start, worst / h);
    }
    return 0;
  }
  const PlanarWave exact(k, units.materials());
  int n_rec = 0, n_steps = 0;
  const double a0 = amplitude(run.foam().films, k, middle), end = 25 / exact.omega_0();
  double squares = 0;
  run.move_until(end, [&](const simulation::MotionStep& step) {
    const double a = amplitude(run.foam().films, k, middle);
    // Velocities live at half steps: the gas was at rest half a step before the films were where they start.
    const double since_rest = run.foam().time + 0.5 * step.limit.dt;
    n_rec += step.reconstructed; ++n_steps;
    squares += step.limit.dt * std::pow(a / a0 - exact.amplitude(since_rest), 2);
    return true;
  });
  fmt::print("   {} cells: {} steps, {} reconstructions\n", cells, n_steps, n_rec);
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
    if (const char* m = std::getenv("MAXC"); m && cells > std::atoi(m)) break;
    const double error = wave_error(communicator, cells);
    report.at_most(fmt::format("rms error of a/a0, {} cells a wave length", cells), error, limit,
                   "exact initial-value solution (Prosperetti 1981); Basilisk's figures");
    if (coarser > 0) report.told("order of convergence", std::log2(coarser / error), "second order", 2.0);
    coarser = error;
  }
}

}  // namespace spume::verification
