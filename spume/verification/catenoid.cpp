#include "spume/verification/catenoid.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"
#include "spume/base/random.hpp"
#include "spume/base/stage_times.hpp"
#include "spume/drainage/equations.hpp"
#include "spume/drainage/step.hpp"
#include "spume/fem/triangle_matrices.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::verification {

namespace {

constexpr double half_height = 1.25, tension = 0.2, weight = 0.5;  // σ, ρg
constexpr int n_samples = 8;

double sech_squared(double v) {
  return 1 / (std::cosh(v) * std::cosh(v));
}

/// The edges along v = ± 5/4.
void find_boundary(Catenoid& mesh) {
  for (const auto& dof : mesh.network.topology.corner_dof)
    for (int c = 0; c < 3; ++c) {
      const int d = dof[c], e = dof[(c + 1) % 3];
      const double v = mesh.parameter[d][1];
      if (v == mesh.parameter[e][1] && std::abs(v) == half_height) mesh.boundary_edge.push_back({d, e});
    }
}

/// Adds ∫ f φ of the source at time t to the balances, f piecewise linear or integrated to fifth order
/// (Radon's seven points) over the flat triangles.
void add_source(const Catenoid& mesh, double t, SourceRule rule, std::vector<double>& rate) {
  constexpr double near = 0.47014206410511505, far = 0.10128650732345633;
  constexpr double weight_near = 0.13239415278850619, weight_far = 0.12593918054482715;
  static constexpr std::array<std::array<double, 4>, 7> points{{
      {1. / 3, 1. / 3, 1. / 3, 0.225},
      {1 - 2 * near, near, near, weight_near},
      {near, 1 - 2 * near, near, weight_near},
      {near, near, 1 - 2 * near, weight_near},
      {1 - 2 * far, far, far, weight_far},
      {far, 1 - 2 * far, far, weight_far},
      {far, far, 1 - 2 * far, weight_far},
  }};
  for (int n = 0; n < mesh.network.mesh.n_triangles(); ++n) {
    const double area = mesh::triangle_area(mesh.network.mesh, n);
    const auto& dof = mesh.network.topology.corner_dof[n];
    if (rule == SourceRule::Interpolated) {
      const auto mass = fem::triangle_mass(area);
      for (int j = 0; j < 3; ++j) {
        const double f = catenoid_solution(mesh.parameter[dof[j]][0], mesh.parameter[dof[j]][1], t).source;
        for (int i = 0; i < 3; ++i) rate[dof[i]] += mass[i][j] * f;
      }
      continue;
    }
    for (const auto& point : points) {
      double u = 0, v = 0;
      for (int i = 0; i < 3; ++i) {
        const double turns = mesh.parameter[dof[i]][0] - mesh.parameter[dof[0]][0];
        u += point[i] * (mesh.parameter[dof[0]][0] + std::remainder(turns, 2 * std::numbers::pi));
        v += point[i] * mesh.parameter[dof[i]][1];
      }
      const double f = point[3] * area * catenoid_solution(u, v, t).source;
      for (int i = 0; i < 3; ++i) rate[dof[i]] += point[i] * f;
    }
  }
}

/// Takes −∫ (Q·ν) φ over the boundary out of the balances, the flux piecewise linear.
void subtract_flux(const Catenoid& mesh, double t, std::vector<double>& rate) {
  const auto flux = [&](int d) {
    return catenoid_solution(mesh.parameter[d][0], mesh.parameter[d][1], t).flux;
  };
  for (const auto& [d, e] : mesh.boundary_edge) {
    const auto& dofs = mesh.network.topology.film_dof;
    const auto mass = fem::segment_mass(norm(mesh.network.mesh.edge(dofs[d].vertex, dofs[e].vertex)));
    rate[d] -= mass[0][0] * flux(d) + mass[0][1] * flux(e);
    rate[e] -= mass[1][0] * flux(d) + mass[1][1] * flux(e);
  }
}

std::vector<double> exact_eta(const Catenoid& mesh, double t) {
  std::vector<double> eta;
  for (const auto& [u, v] : mesh.parameter) eta.push_back(catenoid_solution(u, v, t).eta);
  return eta;
}

/// ‖·‖₂ of a piecewise linear function.
double norm_of(const Catenoid& mesh, const std::vector<double>& f) {
  double square = 0;
  for (int t = 0; t < mesh.network.mesh.n_triangles(); ++t) {
    const auto mass = fem::triangle_mass(mesh::triangle_area(mesh.network.mesh, t));
    const auto& dof = mesh.network.topology.corner_dof[t];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) square += mass[i][j] * f[dof[i]] * f[dof[j]];
  }
  return std::sqrt(square);
}

void measure(const Catenoid& mesh, const std::vector<double>& error, LamellaError& most) {
  for (double e : error) most.largest = std::max(most.largest, std::abs(e));
  most.norm = std::max(most.norm, norm_of(mesh, error));
}

}  // namespace

state::Materials catenoid_materials(const Vec3& direction) {
  return {.gas = {}, .liquid = {1, 1}, .film = {tension}, .gravity = weight * direction};
}

Catenoid catenoid(int n, CatenoidMesh kind) {
  mesh::FilmMesh films;
  std::vector<std::array<double, 2>> place;
  Random random(7);
  const bool uneven = kind == CatenoidMesh::Uneven;
  const int around = 2 * n;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < around; ++i) {
      const double off_u = uneven ? random.uniform(-0.2, 0.2) : 0;
      const double off_v = uneven && j > 0 && j < n ? random.uniform(-0.2, 0.2) : 0;
      const double u = 2 * std::numbers::pi * (i + off_u) / around;
      const double v = half_height * (2 * (j + off_v) - n) / n;
      place.push_back({u, v});
      films.position.push_back({std::cosh(v) * std::cos(u), std::cosh(v) * std::sin(u), v});
    }
  const auto at = [around](int i, int j) { return i % around + around * j; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const bool other_way = uneven && random.uniform() < 0.5;
      films.triangle.push_back(mesh::make_triangle(a, b, other_way ? d : c, 0, 1));
      films.triangle.push_back(mesh::make_triangle(other_way ? b : a, c, d, 0, 1));
    }
  Catenoid mesh;
  mesh.network.topology = mesh::build_topology(films);
  mesh.network.mesh = std::move(films);
  for (const auto& dof : mesh.network.topology.film_dof) {
    mesh.parameter.push_back(place[dof.vertex]);
    const double q = sech_squared(place[dof.vertex][1]);
    mesh.network.curvature_squared.push_back(2 * q * q);
  }
  mesh.network.half_thickness.assign(mesh.parameter.size(), 1.0);
  mesh.network.border_area.assign(mesh.network.mesh.n_vertices(), 0.0);
  find_boundary(mesh);
  return mesh;
}

Vec3 catenoid_normal(double u, double v) {
  return {std::cos(u) / std::cosh(v), std::sin(u) / std::cosh(v), -std::tanh(v)};
}

double catenoid_distance(const Vec3& x) {
  // The foot lies on the meridian of x: Newton's method for v where (r − cosh v, z − v) is normal to it.
  const double r = std::hypot(x.x, x.y);
  double v = x.z;
  for (int n = 0; n < 50; ++n) {
    const double along = (r - std::cosh(v)) * std::sinh(v) + x.z - v;
    const double slope = (r - std::cosh(v)) * std::cosh(v) - std::sinh(v) * std::sinh(v) - 1;
    const double step = along / slope;
    v -= step;
    if (std::abs(step) < 1e-15) break;
  }
  return (r - std::cosh(v)) / std::cosh(v) - (x.z - v) * std::tanh(v);
}

drainage::LamellaSurface catenoid_surface(const Catenoid& mesh, const Vec3& gravity) {
  drainage::LamellaSurface surface;
  for (std::size_t d = 0; d < mesh.parameter.size(); ++d) {
    surface.position.push_back(mesh.network.mesh.position[mesh.network.topology.film_dof[d].vertex]);
    const Vec3 n = catenoid_normal(mesh.parameter[d][0], mesh.parameter[d][1]);
    surface.tangential_gravity.push_back(gravity - dot(gravity, n) * n);
  }
  surface.triangle = mesh.network.topology.corner_dof;
  surface.curvature_squared = mesh.network.curvature_squared;
  return surface;
}

double largest_diameter(const state::FilmNetwork& network) {
  double largest = 0;
  for (int t = 0; t < network.mesh.n_triangles(); ++t) {
    const auto [a, b, c] = network.mesh.corners(t);
    largest = std::max(largest,
                       norm(b - a) * norm(c - b) * norm(a - c) / (2 * mesh::triangle_area(network.mesh, t)));
  }
  return largest;
}

CatenoidSolution catenoid_solution(double u, double v, double t) {
  // The metric is cosh² v (du² + dv²): with q = sech² v, k = 2q² and Δ_s = q (∂_uu + ∂_vv). η = 1 + w and
  // P = kη + Δ_s η = 2q² + r w with r = 2q² − (1 + b²) q.
  const double b = 4 * std::numbers::pi / 5, q = sech_squared(v), th = std::tanh(v);
  const double q1 = -2 * q * th, q2 = 4 * q * th * th - 2 * q * q;               // derivatives of q
  const double s1 = -4 * q * q * th, s2 = 16 * q * q * th * th - 4 * q * q * q;  // of q²
  const double r = 2 * q * q - (1 + b * b) * q, r1 = 2 * s1 - (1 + b * b) * q1,
               r2 = 2 * s2 - (1 + b * b) * q2;
  const double w = 0.25 * std::sin(u + t) * std::cos(b * v), w_u = 0.25 * std::cos(u + t) * std::cos(b * v),
               w_v = -0.25 * b * std::sin(u + t) * std::sin(b * v);
  const double eta = 1 + w, cube = eta * eta * eta;
  const double p_u = r * w_u, p_uu = -r * w;
  const double p_v = 2 * s1 + r1 * w + r * w_v, p_vv = 2 * s2 + r2 * w + 2 * r1 * w_v - r * b * b * w;
  const double divergence = tension * (3 * eta * eta * (w_u * p_u + w_v * p_v) + cube * (p_uu + p_vv)) +
                            weight * 3 * eta * eta * w_v;
  const double along_v = (tension * cube * p_v + weight * cube) / (3 * std::cosh(v));
  return {eta, w_u + q / 3 * divergence, v > 0 ? along_v : -along_v};
}

LamellaRun published_lamella_run(const Catenoid& mesh, drainage::LamellaSurface surface,
                                 const state::Materials& materials, bool driven) {
  // Shared, since functions are copied.
  const auto lamella = std::make_shared<drainage::PaperLamella>(std::move(surface), materials);
  return [lamella, &mesh, driven](double t, double dt, std::vector<double>& eta) {
    std::vector<double> load(eta.size(), 0.0);
    if (driven) {
      add_source(mesh, t, SourceRule::Interpolated, load);
      subtract_flux(mesh, t, load);
    }
    const double begun = processor_time();
    if (!lamella->advance(dt, load, eta)) throw NumericalError("the published lamella scheme blew up");
    return processor_time() - begun;
  };
}

LamellaRun positive_lamella_run(const Catenoid& mesh, const state::Materials& materials,
                                std::optional<SourceRule> driven) {
  const auto equations = std::make_shared<drainage::DrainageEquations>(mesh.network, materials);
  const auto stepper = std::make_shared<drainage::Stepper>(*equations);
  const auto gain_at = [&mesh, driven](double t) {
    drainage::Unknowns gain{std::vector<double>(mesh.parameter.size(), 0.0), {}};
    if (!driven) return gain;
    add_source(mesh, t, *driven, gain.film);
    subtract_flux(mesh, t, gain.film);
    return gain;
  };
  return [equations, stepper, gain_at](double t, double dt, std::vector<double>& eta) {
    const drainage::Unknowns first = gain_at(t + drainage::first_gain * dt),
                             second = gain_at(t + drainage::second_gain * dt);
    const double begun = processor_time();
    stepper->start({eta, {}}, &first);
    const drainage::Trial& trial = stepper->attempt(drainage::Method::Rosenbrock, dt, &second);
    if (!trial.positive) throw NumericalError("the film ran dry on the catenoid");
    eta = trial.y.film;
    return processor_time() - begun;
  };
}

LamellaError lamella_error(const Catenoid& mesh, const LamellaRun& run, double end, int steps) {
  std::vector<double> eta = exact_eta(mesh, 0);
  LamellaError most;
  for (int step = 1; step <= steps; ++step) {
    most.seconds += run(end * (step - 1) / steps, end / steps, eta);
    std::vector<double> error = exact_eta(mesh, end * step / steps);
    for (std::size_t d = 0; d < eta.size(); ++d) error[d] -= eta[d];
    measure(mesh, error, most);
  }
  return most;
}

std::vector<double> lamella_end(const Catenoid& mesh, const LamellaRun& run, double end, int steps) {
  std::vector<double> eta = exact_eta(mesh, 0);
  for (int step = 1; step <= steps; ++step) run(end * (step - 1) / steps, end / steps, eta);
  return eta;
}

LamellaHistory lamella_history(const Catenoid& mesh, const LamellaRun& run, int steps) {
  expects(steps % n_samples == 0, "a multiple of 8 steps");
  const double dt = 2.0 / steps;
  std::vector<double> eta(mesh.parameter.size(), 1.0);
  LamellaHistory history;
  for (int step = 1; step <= steps; ++step) {
    run((step - 1) * dt, dt, eta);
    if (step % (steps / n_samples) == 0) history.push_back(eta);
  }
  return history;
}

std::vector<double> lamella_liquid(const Catenoid& mesh, const LamellaHistory& history) {
  const auto area = mesh::film_dof_areas(mesh.network.mesh, mesh.network.topology);
  std::vector<double> liquid;
  for (const auto& eta : history) {
    long double sum = 0;  // so that what is shown is the scheme and not the summation
    for (std::size_t d = 0; d < eta.size(); ++d) sum += static_cast<long double>(area[d]) * eta[d];
    liquid.push_back(static_cast<double>(sum));
  }
  return liquid;
}

LamellaError lamella_difference(const Catenoid& coarse, const LamellaHistory& eta_coarse, int n,
                                const LamellaHistory& eta_fine) {
  // On a regular mesh the film dofs are the vertices in their order, 2n of them to a row.
  LamellaError most;
  for (std::size_t s = 0; s < eta_coarse.size(); ++s) {
    std::vector<double> difference = eta_coarse[s];
    for (std::size_t d = 0; d < difference.size(); ++d) {
      const std::size_t row = d / (2 * n), column = d % (2 * n);
      difference[d] -= eta_fine[s][4 * n * 2 * row + 2 * column];
    }
    measure(coarse, difference, most);
  }
  return most;
}

}  // namespace spume::verification
