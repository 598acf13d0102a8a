// Decay and growth of small modes on films whose shape is exact, against the linearised equation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "spume/verification/drainage_runs.hpp"
#include "spume/verification/film_networks.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

using std::numbers::pi;

constexpr double size = 1e-3, eta0 = 5e-6;  // of the films [m], of η [m]

/// A mode Y of a film with k = k₁² + k₂² that is the same everywhere, −Δ_s Y = s Y.
struct Mode {
  std::string name;
  std::function<double(const Vec3&)> shape;  ///< Y, of order one
  double eigenvalue;                         ///< s [1/m²]
};

/// η = η₀ (1 + a Y) with a ~ exp(−rate t): the equation linearised about a uniform film without gravity.
double exact_rate(const Mode& mode, double curvature_squared) {
  const auto materials = fig15_materials();
  const double c = materials.film.surface_tension * eta0 * eta0 * eta0 / (3 * materials.liquid.viscosity);
  return c * mode.eigenvalue * (mode.eigenvalue - curvature_squared);
}

/// The rate at which the amplitude falls over one decay time, in n steps.
double measured_rate(const mesh::FilmMesh& mesh, double curvature_squared, const Mode& mode, int n) {
  constexpr double amplitude = 1e-4;  // so that terms of second order are lost among the errors
  auto materials = fig15_materials();
  materials.gravity = {};
  auto network = uniform_network(mesh, eta0, 0);
  std::ranges::fill(network.curvature_squared, curvature_squared);
  std::vector<double> shape;
  for (const Vec3& x : network.mesh.position) shape.push_back(mode.shape(x));
  for (std::size_t d = 0; d < shape.size(); ++d) network.half_thickness[d] *= 1 + amplitude * shape[d];
  drainage::DrainageEquations equations(network, materials);
  const auto amplitude_of = [&](const drainage::Unknowns& y) {
    double sum = 0, square = 0;
    for (std::size_t d = 0; d < shape.size(); ++d) {
      const double m = equations.film_area()[d];
      sum += m * shape[d] * (y.film[d] / eta0 - 1);
      square += m * shape[d] * shape[d];
    }
    return sum / square;
  };
  const auto start = equations.read(network);
  const double time = 1 / std::abs(exact_rate(mode, curvature_squared));
  return std::log(amplitude_of(start) / amplitude_of(march(equations, start, time, n))) / time;
}

/// Rates of one mode on finer and finer meshes, with steps in proportion to the edges.
void compare(const Mode& mode, double curvature_squared, const std::vector<int>& meshes,
             const std::function<mesh::FilmMesh(int)>& mesh_of, Scale scale, Report& report) {
  const double exact = exact_rate(mode, curvature_squared);
  double coarser = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const int n = meshes[m];
    const double rate = measured_rate(mesh_of(n), curvature_squared, mode, n);
    const double error = rate / exact - 1;
    const std::string what = fmt::format("{}, n = {}: ", mode.name, n);
    report.told(what + "rate [1/s]", rate, "linearised equation", exact);
    if (m > 0)
      report.absolute(what + "order", order_of(coarser, error, static_cast<double>(n) / meshes[m - 1]), 2,
                      0.2, "second order in edge and step");
    coarser = error;
  }
  report.at_most(mode.name + ": relative error of the finest", std::abs(coarser),
                 scale == Scale::Full ? 0.01 : 0.05, "linearised equation");
}

}  // namespace

void film_modes_flat(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("a flat film of 1 mm² with its natural boundary, n × n cells and n steps; rate (σ η₀³/3μ) s²");
  const auto meshes = scale == Scale::Full ? std::vector{16, 32, 64} : std::vector{8, 16};
  for (const auto& [p, q] : {std::pair(1, 0), std::pair(2, 1)}) {
    const double kx = pi * p / size, ky = pi * q / size;
    const Mode mode{fmt::format("mode ({}, {})", p, q),
                    [=](const Vec3& x) { return std::cos(kx * x.x) * std::cos(ky * x.y); },
                    kx * kx + ky * ky};
    compare(
        mode, 0, meshes, [](int n) { return rectangle(size, size, n, n); }, scale, report);
  }
}

void film_modes_sphere(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("a sphere of 1 mm, 20 n² triangles and 3 n steps; rate (σ η₀³/3μ R⁴) (l−1) l (l+1) (l+2)");
  const auto meshes = scale == Scale::Full ? std::vector{9, 18, 36} : std::vector{6, 12};
  const Vec3 axis = normalized(Vec3{1, 2, 3});
  for (const int l : {2, 3}) {
    const Mode mode{
        fmt::format("mode l = {}", l),
        [=](const Vec3& x) { return std::legendre(l, std::clamp(dot(x, axis) / norm(x), -1.0, 1.0)); },
        l * (l + 1) / (size * size)};
    compare(
        mode, 2 / (size * size), meshes, [](int n) { return geodesic_sphere(size, n); }, scale, report);
  }
}

void film_modes_cylinder(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note(
      "an open tube of radius R = 1 mm and length 4 R, n rings; rate (σ η₀³/3μ) s (s − 1/R²), "
      "s = m²/R² + q²; a mode with s R² < 1 grows");
  const auto meshes = scale == Scale::Full ? std::vector{12, 24, 48} : std::vector{8, 16};
  const double length = 4 * size;
  for (const auto& [m, p] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 1)}) {
    const double q = pi * p / length;
    const Mode mode{fmt::format("mode m = {}, qR = {:.3f}", m, q * size),
                    [=](const Vec3& x) { return std::cos(m * std::atan2(x.y, x.x)) * std::cos(q * x.z); },
                    m * m / (size * size) + q * q};
    compare(
        mode, 1 / (size * size), meshes, [=](int n) { return tube(size, length, 3 * n / 2, n); }, scale,
        report);
  }
}

}  // namespace spume::verification
