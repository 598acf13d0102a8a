// Films and Plateau borders that drain by their weight, against closed forms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "spume/drainage/constants.hpp"
#include "spume/drainage/drain.hpp"
#include "spume/verification/drainage_runs.hpp"
#include "spume/verification/film_networks.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

constexpr double gravity = 9.8;  // [m/s²]

std::vector<double> evenly(double first, double last, int n) {
  std::vector<double> values;
  for (int i = 0; i <= n; ++i) values.push_back(first + (last - first) * i / n);
  return values;
}

/// A straight border that goes down along +z from the first of the heights, with films too thin to feed it.
state::FilmNetwork falling_border(const std::vector<double>& heights) {
  constexpr double dry = 1e-10;  // η [m]; Q ~ η^{5/2} is then 1e-9 of what would change λ in a second
  return uniform_network(three_strips(std::vector{0.0, 1e-4}, heights), dry, 5e-8);
}

state::Materials downwards(const Vec3& direction) {
  auto materials = fig15_materials();
  materials.gravity = gravity * direction;
  return materials;
}

/// Largest relative error of η = sqrt(μ z/(ρ g t)) in the middle of a vertical film of n cells.
double error_of_vertical_film(int n) {
  constexpr double length = 20e-3, lowest_eta = 5e-6;
  auto materials = downwards({0, 1, 0});
  materials.film.surface_tension *=
      0.1;  // then the law holds to 1e-5 where it is looked at, and not at the ends
  const double c = materials.liquid.viscosity / (materials.liquid.density * gravity);  // μ/ρg [m s]
  const double start = c * length / (lowest_eta * lowest_eta), end = 4 * start, h = length / n;
  const auto exact = [&](double z, double t) { return std::sqrt(c * z / t); };
  auto network = uniform_network(rectangle(h, length, 1, n), lowest_eta, 0);
  for (int v = 0; v < network.mesh.n_vertices(); ++v) {
    const double z = network.mesh.position[v].y;
    // The uppermost vertices stand for what lies within h/2 of the top.
    network.half_thickness[v] = z > 0 ? exact(z, start) : 2.0 / 3 * exact(h / 2, start);
  }
  // Steps are not all alike: a dimple above the pool at the bottom needs short ones at first.
  const drainage::DrainageParameters parameters{
      .max_time = end - start, .tolerance = 1e-4, .max_step = 0.1 * start};
  drainage::drain(network, materials, parameters, 0, [](const auto&) { return state::ThinPoint{}; }, {});
  double error = 0;
  for (int v = 0; v < network.mesh.n_vertices(); ++v) {
    const double z = network.mesh.position[v].y;
    if (z > 0.25 * length && z < 0.6 * length)
      error = std::max(error, std::abs(network.half_thickness[v] / exact(z, end) - 1));
  }
  return error;
}

/// Relative error at the top or, with gravity reversed, at the bottom of a sphere after a second.
double error_of_apex(int frequency, double up) {
  constexpr double radius = 1e-3, eta0 = 5e-6, time = 1;
  auto materials = downwards({0, 0, -up});
  materials.film.surface_tension = 0;
  const auto network = uniform_network(geodesic_sphere(radius, frequency), eta0, 0);
  drainage::DrainageEquations equations(network, materials);
  const auto y = march(equations, equations.read(network), time, frequency);
  const auto highest = std::ranges::max_element(network.mesh.position, {}, &Vec3::z);
  const double s =
      4 * materials.liquid.density * gravity * eta0 * eta0 * time / (3 * materials.liquid.viscosity * radius);
  return y.film[highest - network.mesh.position.begin()] / (eta0 / std::sqrt(1 + up * s)) - 1;
}

/// Wetting front between u = sqrt(λ) = a above and b below, from its place at time 0; z in units of δ.
struct Front {
  double a, b;   ///< [m]
  double delta;  ///< δ = 2 C₁/(ρ g a) [m]
  double speed;  ///< (C_Δ/μ) ρ g (a² + b²) [m/s]

  /// u at a depth z below the front: the root of
  /// a artanh(u/a) − b arcoth(u/b) = −(z/δ) (a² − b²)/a; a tanh(−z/δ) for b = 0.
  double root(double z) const {
    double low = b, high = a;
    for (int n = 0; n < 200; ++n) {
      const double u = 0.5 * (low + high);
      const double left = a * std::atanh(u / a) - b * std::atanh(b / u);
      (left < -(z / delta) * (a * a - b * b) / a ? low : high) = u;
    }
    return 0.5 * (low + high);
  }
};

Front front_between(double wet, double dry, const state::Materials& materials) {
  const double a = std::sqrt(wet), weight = materials.liquid.density * gravity;
  return {a, std::sqrt(dry), 2 * drainage::border_tension(materials.film.surface_tension) / (weight * a),
          drainage::border_flow / materials.liquid.viscosity * weight * (wet + dry)};
}

/// Largest error of sqrt(λ) over that of the wet border, in the front after it has moved by two δ.
double error_of_front(double dry, int per_delta) {
  constexpr double wet = 5e-8;
  const auto materials = downwards({0, 0, 1});
  const Front front = front_between(wet, dry, materials);
  // As long as no end of the border is felt within four δ of the front.
  auto network = falling_border(evenly(-14 * front.delta, 12 * front.delta, 26 * per_delta));
  for (int v = 0; v < network.mesh.n_vertices(); ++v)
    if (network.border_area[v] > 0)
      network.border_area[v] = std::pow(front.root(network.mesh.position[v].z), 2);
  drainage::DrainageEquations equations(network, materials);
  const double way = 2 * front.delta;
  const auto y = march(equations, equations.read(network), way / front.speed, 8 * per_delta);
  double error = 0;
  for (int u = 0; u < equations.borders().size(); ++u) {
    const double z = network.mesh.position[equations.borders().vertex[u]].z - way;
    if (std::abs(z) > 4 * front.delta) continue;
    error = std::max(error, std::abs(std::sqrt(y.border[u]) - front.root(z)) / front.a);
  }
  return error;
}

}  // namespace

void vertical_film(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("a vertical film of 20 mm thins from η = sqrt(μz/(ρgt)) for four times its age, n cells");
  double coarser = 0;
  for (const int n : scale == Scale::Full ? std::vector{80, 160, 320} : std::vector{80, 160}) {
    const double error = error_of_vertical_film(n);
    report.told(fmt::format("n = {}: relative error, z/L from 0.25 to 0.6", n), error, "closed form", 0.0);
    if (coarser > 0)
      report.absolute(fmt::format("n = {}: order", n), order_of(coarser, error), 2, 0.3, "second order");
    coarser = error;
  }
  report.at_most("relative error of the finest", coarser, 0.01, "closed form");
}

void spherical_film(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("top and bottom of a sphere of 1 mm without tension, 20 n² triangles and n steps to 1 s");
  for (const double up : {1.0, -1.0}) {
    const std::string where = up > 0 ? "top" : "bottom";
    double coarser = 0;
    for (const int n : scale == Scale::Full ? std::vector{9, 18, 36} : std::vector{6, 12}) {
      const double error = error_of_apex(n, up);
      report.told(fmt::format("{}, n = {}: relative error", where, n), error, "η₀ (1 ± 4ρgη₀²t/(3μR))^(-1/2)",
                  0.0);
      if (coarser != 0)
        report.absolute(fmt::format("{}, n = {}: order", where, n), order_of(coarser, error), 2, 0.25,
                        "second order");
      coarser = error;
    }
    report.at_most(where + ": relative error of the finest", std::abs(coarser), 0.01, "closed form");
  }
}

void border_front(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("a wet border runs into a drier one; n edges in δ = 2C₁/(ρg sqrt(λ)), 4 n steps a δ");
  const auto meshes = scale == Scale::Full ? std::vector{8, 16, 32} : std::vector{8, 16};
  double coarser = 0;
  for (const int n : meshes) {
    const double error = error_of_front(0.09 * 5e-8, n);
    report.told(fmt::format("λ 1 : 0.09, n = {}: error of sqrt(λ)", n), error, "closed form", 0.0);
    if (coarser > 0)
      report.absolute(fmt::format("λ 1 : 0.09, n = {}: order", n), order_of(coarser, error), 2, 0.25,
                      "second order");
    coarser = error;
  }
  report.at_most("λ 1 : 0.09: error of the finest", coarser, 0.01, "closed form");
  report.at_most(fmt::format("λ 1 : 1e-4, n = {}: error of sqrt(λ)", meshes.back()),
                 error_of_front(1e-4 * 5e-8, meshes.back()), scale == Scale::Full ? 0.02 : 0.05,
                 "tanh² front");
}

void border_hydrostatic(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  constexpr double length = 10e-3;
  report.note("a vertical border of 10 mm comes to rest: λ^(-1/2) linear in height");
  const auto materials = downwards({0, 0, 1});
  const double slope = materials.liquid.density * gravity /
                       (2 * drainage::border_tension(materials.film.surface_tension));  // of λ^(-1/2) [1/m²]
  // ∫λ = L/(s₀ s₁) for λ = s^(-2) with s linear, and it is the liquid of the start.
  const double half = 0.5 * slope * length, lowest = std::sqrt(half * half + 1 / 5e-8) - half;
  double coarser = 0;
  for (const int n : scale == Scale::Full ? std::vector{8, 16, 32} : std::vector{8, 16}) {
    auto network = falling_border(evenly(0, length, n));
    const auto outcome =
        drainage::drain(network, materials, {.max_time = 100, .tolerance = 0.02, .max_step = 10}, 0,
                        [](const auto&) { return state::ThinPoint{}; }, {});
    const auto root = [&](int v) { return 1 / std::sqrt(network.border_area[v]); };
    double bend = 0;
    for (int v = 0; v <= n; ++v)
      bend = std::max(bend, std::abs(root(v) - root(n) - slope * (length - network.mesh.position[v].z)));
    report.at_most(fmt::format("n = {}: distance from the line over its rise", n), bend / (slope * length),
                   1e-9, "hydrostatics; the scheme is exactly at rest there");
    report.at_most(fmt::format("n = {}: ledger", n), std::abs(outcome.ledger_error), 1e-13,
                   "nothing is lost");
    const double error = root(n) / lowest - 1;
    report.told(fmt::format("n = {}: relative error of λ^(-1/2) at the bottom", n), error,
                "closed form for the liquid of the start", 0.0);
    if (coarser != 0)
      report.absolute(fmt::format("n = {}: order", n), order_of(coarser, error), 2, 0.2, "second order");
    coarser = error;
  }
}

}  // namespace spume::verification
