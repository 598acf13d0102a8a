#include "spume/config/assess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spume/config/text.hpp"
#include "spume/io/film_frame.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/simulation/cluster.hpp"
#include "spume/simulation/film_source.hpp"
#include "spume/simulation/labels.hpp"

namespace spume::config {

namespace {

using simulation::BubbleShape;
using simulation::Case;
using Interface = simulation::RearrangementParameters::Interface;

double smallest_diameter(const std::vector<BubbleShape>& bubbles) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& bubble : bubbles)
    smallest = std::min({smallest, bubble.semi_axes.x, bubble.semi_axes.y, bubble.semi_axes.z});
  return 2 * smallest;
}

double mean_diameter(const std::vector<BubbleShape>& bubbles) {
  double sum = 0;
  for (const auto& bubble : bubbles) sum += 2 * simulation::equivalent_radius(bubble);
  return sum / static_cast<double>(bubbles.size());
}

/// The limits that hold all the time, and that of advection at the speed that tension gives the gas of a
/// bubble, u² = 2σ / (ρ_g R).
std::vector<flow::StepLimit> step_limits(const Case& run_case, double h, double diameter) {
  const double speed =
      std::sqrt(4 * run_case.materials.film.surface_tension / (run_case.materials.gas.density * diameter));
  return {flow::capillary_limit(h, run_case.materials, run_case.rearrangement.capillary_factor),
          {run_case.rearrangement.cfl * h / speed,
           fmt::format("advection, where the gas moves at {:.2g} m/s as after a rupture", speed)}};
}

/// Of films that are there already.
FoamEstimate estimate_films(const simulation::FilmsSource& source, const simulation::InitialFoam& start) {
  const auto sourced = simulation::load_films(source, start.lamella_half_thickness, start.border_area);
  FoamEstimate of_films;
  of_films.film_area = mesh::film_area(sourced.films);
  for (const double length : mesh::border_lengths(sourced.films, sourced.topology))
    of_films.border_length += length;
  for (const double volume : simulation::volumes_of(sourced.films)) of_films.gas_volume += volume;
  return of_films;
}

FoamEstimate estimate(const Case& run_case, const std::vector<BubbleShape>& bubbles) {
  const grid::Box& box = run_case.box;
  const auto& foam = run_case.foam;
  if (foam.lattice) return estimate_full_box(static_cast<int>(bubbles.size()), box);
  if (foam.labels) return estimate_labels(simulation::load_labels(*foam.labels, box), box);
  if (foam.films) return estimate_films(*foam.films, foam);
  FoamEstimate of_bubbles = estimate_foam(bubbles, box);
  if (foam.membrane) {
    const Vec3 n = normalized(foam.membrane->normal);
    of_bubbles.film_area += box.domain().volume() / std::abs(dot(n, box.size()));
  }
  return of_bubbles;
}

/// Fitted to runs of the quick-start case on 48³ to 96³ cells on one core of an AMD EPYC (Zen 5),
/// reconstructions spread over the steps; with the Voronoi implicit interface method, which reconstructs at
/// every step, to a run with four bubbles on 64³. Other machines and foams differ by a factor of two.
void estimate_cost(Assessment& a, bool by_viim) {
  constexpr double seconds_per_cell = 3e-7;
  const double seconds_per_triangle = by_viim ? 5e-5 : 2e-6;
  constexpr double bytes_at_start = 7e7, bytes_per_cell = 600, bytes_per_triangle = 1000;
  // Triangles of the film mesh have edges of about h.
  const double n_triangles = a.foam.film_area / (std::numbers::sqrt3 / 4 * a.h * a.h);
  a.seconds_per_step = seconds_per_cell * a.n_cells + seconds_per_triangle * n_triangles;
  a.memory = bytes_at_start + bytes_per_cell * a.n_cells + bytes_per_triangle * n_triangles;
}

void warn_of_grid(Assessment& a) {
  constexpr double enough_cells = 8;
  if (a.smallest_diameter < enough_cells * a.h)
    a.warnings.push_back(
        fmt::format("the smallest bubble is {:.1f} cells across; {} or more resolve its films",
                    a.smallest_diameter / a.h, enough_cells));
}

void warn_of_liquid(Assessment& a, const Case& run_case, double thinnest) {
  constexpr double dry = 0.1, slender = 0.2;
  if (a.liquid_fraction > dry)
    a.warnings.push_back(
        fmt::format("the liquid fraction is {:.0f} %: the model is for dry foams, below {:.0f} %",
                    100 * a.liquid_fraction, 100 * dry));
  if (a.border_radius > slender * a.smallest_diameter / 2)
    a.warnings.push_back(fmt::format(
        "Plateau borders have a radius of {:.2g} m, {:.0f} % of that of the smallest bubble: the model "
        "takes them for thin lines, below {:.0f} %",
        a.border_radius, 200 * a.border_radius / a.smallest_diameter, 100 * slender));
  if (run_case.rupture.threshold >= thinnest)
    a.warnings.push_back("films start below the rupture threshold: they break at once");
}

void warn_of_pockets(Assessment& a, const Case& run_case) {
  if (run_case.foam.cluster) return;  // a cluster shares its pockets among the bubbles around them
  for (const auto& pocket : a.foam.pockets)
    a.warnings.push_back(
        fmt::format("the bubbles enclose a pocket of the outside near [{:.3g}, {:.3g}, {:.3g}] m of "
                    "{:.2g} m³; it becomes a bubble of its own",
                    pocket.position.x, pocket.position.y, pocket.position.z, pocket.volume));
}

std::string bytes_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string duration_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.2g} s", seconds);
  if (seconds < 3600) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 48 * 3600) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

using Rows = std::vector<std::vector<std::string>>;

void add_grid(const Assessment& a, const Index3& n, Rows& rows) {
  rows.push_back({"grid", fmt::format("{} × {} × {} cells of h = {:.4g} m", n.i, n.j, n.k, a.h)});
  rows.push_back(
      {"bubbles", fmt::format("{}; the smallest is {:.3g} m across, {:.1f} h; the mean {:.3g} m", a.n_bubbles,
                              a.smallest_diameter, a.smallest_diameter / a.h, a.mean_diameter)});
  for (const auto& limit : a.step_limits)
    rows.push_back({"time step", fmt::format("≤ {:.3g} s  {}", limit.dt, limit.reason)});
  rows.push_back({"", "viscosity sets no limit (Crank–Nicolson); drainage chooses its own steps"});
  rows.push_back({"Laplace number", fmt::format("{:.3g} of the gas in the mean bubble", a.laplace_number)});
}

void add_foam(const Assessment& a, Rows& rows) {
  rows.push_back({"films", fmt::format("about {:.3g} m², borders about {:.3g} m, gas {:.3g} m³",
                                       a.foam.film_area, a.foam.border_length, a.foam.gas_volume)});
  rows.push_back({"liquid", fmt::format("about {:.2g} m³, {:.2g} % of the gas", a.liquid_volume,
                                        100 * a.liquid_fraction)});
  rows.push_back(
      {"border radius", fmt::format("{:.3g} m, {:.1f} % of the radius of the smallest bubble",
                                    a.border_radius, 200 * a.border_radius / a.smallest_diameter)});
}

void add_cost(const Assessment& a, Rows& rows) {
  const double dt = a.step_limits.front().dt;
  rows.push_back({"memory", "about " + bytes_text(a.memory)});
  rows.push_back({"cost", fmt::format("about {} of one core for each millisecond of rearrangement ({:.0f} "
                                      "steps of {}); drainage is extra",
                                      duration_text(1e-3 / dt * a.seconds_per_step), std::ceil(1e-3 / dt),
                                      duration_text(a.seconds_per_step))});
}

}  // namespace

Assessment assess(const Case& run_case, const std::vector<BubbleShape>& bubbles) {
  const grid::Box& box = run_case.box;
  const state::Materials& materials = run_case.materials;
  const double mu = materials.gas.viscosity;            // μ_g [Pa s]
  const double rho = materials.gas.density;             // ρ_g [kg/m³]
  const double sigma = materials.film.surface_tension;  // σ [N/m]

  Assessment a{};
  a.h = box.spacing();
  a.n_cells = static_cast<double>(box.cells.i) * box.cells.j * box.cells.k;
  a.n_bubbles = static_cast<int>(bubbles.size());
  a.smallest_diameter = smallest_diameter(bubbles);
  a.mean_diameter = mean_diameter(bubbles);
  if (!run_case.foam.films) a.step_limits = step_limits(run_case, a.h, a.mean_diameter);
  a.laplace_number = 2 * sigma * rho * a.mean_diameter / (mu * mu);
  a.foam = estimate(run_case, bubbles);
  double lambda = run_case.foam.border_area;  // λ [m²]
  a.liquid_volume =
      2 * run_case.foam.lamella_half_thickness * a.foam.film_area + lambda * a.foam.border_length;
  double thinnest = run_case.foam.lamella_half_thickness;  // η [m]
  if (run_case.foam.films) {
    const auto sourced =
        simulation::load_films(*run_case.foam.films, run_case.foam.lamella_half_thickness, lambda);
    a.liquid_volume = sourced.liquid.total();
    lambda = a.foam.border_length > 0 ? sourced.liquid.in_borders() / a.foam.border_length : 0;
    thinnest = std::ranges::min(io::half_thickness(sourced.films, sourced.topology, sourced.liquid));
  }
  a.liquid_fraction = a.liquid_volume / a.foam.gas_volume;
  a.border_radius = std::sqrt(lambda / (std::numbers::sqrt3 - std::numbers::pi / 2));
  estimate_cost(a, run_case.rearrangement.interface == Interface::Viim);
  if (!run_case.foam.films) warn_of_grid(a);
  warn_of_liquid(a, run_case, thinnest);
  warn_of_pockets(a, run_case);
  if (run_case.rearrangement.interface == Interface::Viim &&
      run_case.rearrangement.dynamics == simulation::RearrangementParameters::Dynamics::Quasistatic)
    a.warnings.push_back("interface \"viim\" has no effect with quasistatic dynamics, which moves the mesh");
  return a;
}

std::string report(const Assessment& a, const Case& run_case) {
  const bool on_grid = !run_case.foam.films;
  Rows rows;
  if (on_grid) add_grid(a, run_case.box.cells, rows);
  add_foam(a, rows);
  if (on_grid) add_cost(a, rows);
  std::string text = aligned(rows);
  for (const auto& warning : a.warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace spume::config
