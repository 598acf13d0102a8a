#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "spume/mesh/measure.hpp"
#include "spume/transport/liquid_mesh.hpp"
#include "spume/verification/bubble_wave.hpp"
#include "spume/verification/clusters.hpp"
#include "spume/verification/film_tracers.hpp"
#include "spume/verification/modes.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

using std::numbers::pi;

/// η/η0 at every film dof of films that started with η0 everywhere.
std::vector<double> relative_thickness(FoamRun& run, std::span<const double> dof_area) {
  std::vector<double> eta(run.foam().liquid.lamella_volume);
  for (std::size_t d = 0; d < eta.size(); ++d)
    eta[d] /= 2 * run.run_case().foam.lamella_half_thickness * dof_area[d];
  return eta;
}

/// −(2n+1)/4π ∫ (η/η0 − 1) P_n over the directions from the middle of a bubble.
double stretch_of_mode(FoamRun& run, int n) {
  const mesh::FilmMesh& films = run.foam().films;
  const auto& topology = run.topology();
  const std::vector<double> area = mesh::film_dof_areas(films, topology), eta = relative_thickness(run, area);
  const Vec3 centre = centroid(films, 1);
  double sum = 0;
  for (std::size_t d = 0; d < eta.size(); ++d) {
    const Vec3 x = films.position[topology.film_dof[d].vertex] - centre;
    const double r = norm(x), solid_angle = area[d] / (r * r);
    sum -= solid_angle * (eta[d] - 1) * std::legendre(n, std::clamp(x.z / r, -1.0, 1.0));
  }
  return (2 * n + 1) / (4 * pi) * sum;
}

/// What a bubble that starts with mode 2 does to its film, at every step.
struct RiddenMode {
  std::vector<double> since_rest, stretch, amplitude;  ///< [s], [−], over R
  double start;                                        ///< amplitude over R
};

RiddenMode ride_mode(const parallel::Communicator& communicator, const Units& units, int cells_per_radius,
                     double amplitude, double end) {
  const double radius = units.radius;
  FoamRun run(communicator, cube_case(units, 6 * cells_per_radius, cells_per_radius), 1,
              [&](mesh::Phase phase, const Vec3& x) {
                const double r = norm(x), cosine = r > 0 ? x.z / r : 1;
                const double outwards = r - radius * (1 + amplitude * std::legendre(2, cosine));
                return phase == 0 ? 0.5 * outwards : -0.5 * outwards;
              });
  RiddenMode ridden{{}, {}, {}, mode_amplitude(run.foam().films, 1, 2) / radius};
  run.move_until(end, [&](const simulation::MotionStep& step) {
    // Velocities live at half steps: the gas was at rest half a step before the films were where they start.
    ridden.since_rest.push_back(run.foam().time + 0.5 * step.limit.dt);
    ridden.stretch.push_back(stretch_of_mode(run, 2));
    ridden.amplitude.push_back(mode_amplitude(run.foam().films, 1, 2) / radius);
    return true;
  });
  return ridden;
}

/// Rms errors over one and a half periods of the stretch of a film by mode 2, e R/a0.
struct StretchErrors {
  double of_wave;    ///< against the exact wave
  double of_motion;  ///< against what the bubble's own motion asks in the exact flow
};

/// Of first order in the amplitude: half the difference of two bubbles, long and flat, which have the second
/// order in common.
StretchErrors errors_of_stretch(const parallel::Communicator& communicator, int cells_per_radius) {
  constexpr double viscosity = 0.05, amplitude = 0.02;
  const Units units = units_of_viscosity(viscosity);
  const BubbleWave exact(2, units.radius, units.materials());
  const double end = 1.5 * 2 * pi / bubble_mode(2, units.radius, units.materials()).omega;
  const RiddenMode longer = ride_mode(communicator, units, cells_per_radius, amplitude, end),
                   flatter = ride_mode(communicator, units, cells_per_radius, -amplitude, end);
  const std::size_t n = std::min(longer.stretch.size(), flatter.stretch.size()) - 1;  // equal steps
  const double start = longer.start - flatter.start;
  std::vector<double> response, change;
  StretchErrors squares{};
  double before = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double since_rest = longer.since_rest[i],
                 stretch = (longer.stretch[i] - flatter.stretch[i]) / start;
    const double now = (longer.amplitude[i] - flatter.amplitude[i]) / start;
    response.push_back(exact.response(since_rest));  // at half steps: since_rest[i] = (i + 3/2) Δt
    change.push_back(now - before);
    before = now;
    const double step = longer.since_rest[1] - longer.since_rest[0];
    double asked = exact.response(0.5 * step) * change[i];
    for (std::size_t j = 0; j < i; ++j) asked += response[i - 1 - j] * change[j];
    squares.of_wave += std::pow(stretch - exact.stretch(since_rest), 2);
    squares.of_motion += std::pow(stretch - asked, 2);
  }
  const auto count = static_cast<double>(n);
  return {std::sqrt(squares.of_wave / count), std::sqrt(squares.of_motion / count)};
}

/// Rms of η/η0 − 1 by area after ten capillary times of an exact cluster, whose films do not move.
double gathered_at_rest(const parallel::Communicator& communicator, int n, int cells_per_radius) {
  const Units units = units_of_laplace_number(1e5);
  const int cells = (n == 1 ? 3 : 4) * cells_per_radius + (cells_per_radius < 16 ? 8 : 0);
  FoamRun run(communicator, with_cluster(cube_case(units, cells, cells_per_radius), units, n));
  put_onto_exact_cluster(run, units.radius);
  auto& foam = run.foam();
  foam.liquid =
      transport::uniform_liquid(foam.films, run.topology(), run.run_case().foam.lamella_half_thickness,
                                run.run_case().foam.border_area);
  run.move_until(10 * units.time());
  const std::vector<double> area = mesh::film_dof_areas(foam.films, run.topology()),
                            eta = relative_thickness(run, area);
  double squares = 0, whole = 0;
  for (std::size_t d = 0; d < eta.size(); ++d) {
    squares += area[d] * std::pow(eta[d] - 1, 2);
    whole += area[d];
  }
  return std::sqrt(squares / whole);
}

/// η/η0 in the mean over a patch around every film dof, with weights exp(−r²/2 radius²), of areas at the
/// start.
std::vector<double> over_patches(const transport::LiquidMesh& mesh, std::span<const double> start_area,
                                 double radius) {
  std::vector<double> mean(start_area.size());
  std::vector<transport::Neighbour> near;
  for (std::size_t d = 0; d < mean.size(); ++d) {
    const Vec3& x = mesh.film_position(static_cast<int>(d));
    mesh.film_bins.within(x, 3 * radius, near);
    double before = 0, now = 0;
    for (const auto& neighbour : near) {
      if (mesh.lamella_of_dof[neighbour.point] != mesh.lamella_of_dof[d]) continue;
      const Vec3 away = mesh.film_position(neighbour.point) - x;
      const double weight = std::exp(-0.5 * dot(away, away) / (radius * radius));
      before += weight * start_area[neighbour.point];
      now += weight * mesh.dof_area[neighbour.point];
    }
    mean[d] = before / now;
  }
  return mean;
}

/// The liquid of films against that of material points, over patches.
struct Riding {
  double variation;   ///< rms of η/η0 − 1 by the points
  double difference;  ///< rms of η/η0 of the films less that of the points
  double ledger;      ///< relative change of all liquid
  int n_reconstructions = 0;
};

/// Five capillary times of four spheres that start 15 % too far apart and pull together. Patches of R/4.
Riding ride_cluster(const parallel::Communicator& communicator, int cells_per_radius) {
  const Units units = units_of_laplace_number(1e5);
  FoamRun run(communicator,
              with_cluster(cube_case(units, 4 * cells_per_radius + 8, cells_per_radius), units, 4, 1.15));
  const double before = run.foam().liquid.total(), h = run.grid().h();
  FilmTracers tracers(run.foam().films);
  Riding riding{};
  run.move_until(5 * units.time(), [&](const simulation::MotionStep& step) {
    tracers.move(run.film_velocity(), step.limit.dt);
    riding.n_reconstructions += step.reconstructed;
    return true;
  });
  const auto mesh = transport::measure_liquid_mesh(run.foam().films, run.topology(), h);
  std::vector<double> start_area(run.foam().liquid.lamella_volume);
  for (double& a : start_area) a /= 2 * run.run_case().foam.lamella_half_thickness;
  const double patch = 0.25 * units.radius;
  const auto of_films = over_patches(mesh, start_area, patch),
             of_points = over_patches(mesh, tracers.area_at_dofs(mesh, h), patch);
  double whole = 0;
  for (std::size_t d = 0; d < of_films.size(); ++d) {
    riding.variation += mesh.dof_area[d] * std::pow(of_points[d] - 1, 2);
    riding.difference += mesh.dof_area[d] * std::pow(of_films[d] - of_points[d], 2);
    whole += mesh.dof_area[d];
  }
  riding.variation = std::sqrt(riding.variation / whole);
  riding.difference = std::sqrt(riding.difference / whole);
  riding.ledger = std::abs(run.foam().liquid.total() / before - 1);
  return riding;
}

}  // namespace

void liquid_transport(const parallel::Communicator& communicator, Scale scale, Report& report) {
  const bool full = scale == Scale::Full;
  report.note(
      "mode 2 of a bubble, μ = 0.05, a0 = ±0.02 R, box 6 R wide: stretch of its film over 1.5 periods");
  int coarser_cells = 0;
  StretchErrors coarser_errors{};
  for (const int cells : full ? std::vector<int>{6, 8, 12} : std::vector<int>{6, 8}) {
    const StretchErrors errors = errors_of_stretch(communicator, cells);
    const auto order = [&](double coarse, double fine) {
      return std::log(coarse / fine) / std::log(1.0 * cells / coarser_cells);
    };
    report.told(fmt::format("R = {} h: error of e R/a0 in the bubble's own motion", cells), errors.of_motion,
                "exact linear flow", 0.0);
    if (coarser_cells > 0)
      report.absolute("its order", order(coarser_errors.of_motion, errors.of_motion), 1.5, 0.5,
                      "between first and second");
    report.told(fmt::format("R = {} h: error of e R/a0, of frequency and damping too", cells), errors.of_wave,
                "exact wave", 0.0);
    if (coarser_cells > 0)
      report.told("its order", order(coarser_errors.of_wave, errors.of_wave), "second", 2.0);
    coarser_errors = errors;
    coarser_cells = cells;
  }

  report.note("exact clusters at rest, La = 1e5, ten capillary times: rms of η/η0 − 1");
  for (const int n : full ? std::vector<int>{1, 4} : std::vector<int>{1}) {
    const double coarse = gathered_at_rest(communicator, n, 8), fine = gathered_at_rest(communicator, n, 12);
    report.told(fmt::format("{} bubble(s), R = 8 h", n), coarse, "uniform", 0.0);
    report.told(fmt::format("{} bubble(s), R = 12 h", n), fine, "uniform", 0.0);
    report.at_most("their ratio", fine / coarse, 8.0 / 12, "falls at first order at least");
  }

  report.note("four spheres pull together, La = 1e5, five capillary times; means over patches of R/4");
  double coarser = 0;
  for (const int cells : full ? std::vector<int>{8, 12} : std::vector<int>{8}) {
    const Riding riding = ride_cluster(communicator, cells);
    report.note(fmt::format("R = {} h, {} reconstructions", cells, riding.n_reconstructions));
    report.told("rms of η/η0 − 1", riding.variation, "material points");
    report.at_most("rms difference from material points, of that", riding.difference / riding.variation, 0.1,
                   "flat triangles: (kh)²/12 at kh = 1");
    if (coarser > 0)
      report.at_most("difference, over that on the coarser grid", riding.difference / coarser, 1, "falls");
    report.at_most("change of the liquid, relative", riding.ledger, 1e-13, "conserved");
    coarser = riding.difference;
  }
}

}  // namespace spume::verification
