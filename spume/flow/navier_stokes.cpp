#include "spume/flow/navier_stokes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"
#include "spume/flow/crank_nicolson.hpp"
#include "spume/flow/godunov.hpp"
#include "spume/flow/projection.hpp"
#include "spume/flow/wide_mean.hpp"
#include "spume/grid/layer_window.hpp"

namespace spume::flow {

/// The parts of the scheme and their work arrays.
struct NavierStokes::Implementation {
  Implementation(const grid::Grid& on, const state::Gas& of, const FlowParameters& parameters)
      : grid(on),
        gas(of),
        elliptic(on, parameters.elliptic, parameters.elliptic_tolerance),
        godunov(on, parameters.limit_slopes),
        projection(on, elliptic),
        rate(on),
        velocity(ghosted_vector(rate)),
        force(velocity[0]),
        pressure(velocity[0]),
        acceleration(block_vector(BlockLayout(on))),
        window(on, 2) {}

  void mean_on_faces(const grid::Field& u, int c, BlockArray& face);
  void intermediate_rate(const state::GasFlow& flow, const grid::VectorField& body_force, double dt);

  const grid::Grid& grid;
  state::Gas gas;
  grid::EllipticSolver elliptic;
  Godunov godunov;
  Projection projection;
  grid::VectorField rate;  ///< (u* − uⁿ)/Δt, then (uⁿ⁺¹ − uⁿ)/Δt [m/s²]
  GhostedVector velocity;
  GhostedField force;  ///< one component of it
  GhostedField pressure;
  BlockVector acceleration;
  grid::LayerWindow window;
  StageTimes times;
};

NavierStokes::NavierStokes(const grid::Grid& grid, const state::Gas& gas, const FlowParameters& parameters)
    : implementation_(std::make_unique<Implementation>(grid, gas, parameters)) {
  expects(gas.density > 0 && gas.viscosity >= 0, "gas with positive density and no negative viscosity");
}
NavierStokes::~NavierStokes() = default;

/// The rate of change (u* − uⁿ)/Δt towards the intermediate velocity, into `rate`. Collective.
///
/// Paper: Sec. 3.2.1, Eq. (7).
///   ρ ((u* − uⁿ)/Δt + (u·∇u)^{n+½}) = −∇p^{n−½} + μ ½(∇²u* + ∇²uⁿ) + st
void NavierStokes::Implementation::intermediate_rate(const state::GasFlow& flow,
                                                     const grid::VectorField& body_force, double dt) {
  pressure.update(flow.pressure);
  for (int c = 0; c < 3; ++c) {
    velocity[c].update(flow.velocity[c]);
    force.update(body_force[c]);
    explicit_acceleration(grid, gas, c, velocity[c], pressure, force, acceleration[c]);
  }
  times.lap("explicit terms");

  godunov.predict_normals(velocity, acceleration, max_speed(flow), dt);
  times.lap("advection");
  projection.clear_divergence(godunov.face_velocity());
  times.lap("MAC projection");
  godunov.accelerate(velocity, acceleration, dt, rate);
  times.lap("advection");
  diffuse_implicitly(elliptic, gas, dt, rate);
  times.lap("diffusion");
}

void NavierStokes::step(state::GasFlow& flow, const grid::VectorField& body_force, double dt) {
  expects(dt > 0, "a positive time step");
  Implementation& now = *implementation_;
  now.times.restart();
  now.intermediate_rate(flow, body_force, dt);
  now.projection.project(now.gas.density, now.rate, flow.pressure);

  for (int c = 0; c < 3; ++c) {
    const std::span<const double> rate = now.rate[c].values();
    const std::span<double> u = flow.velocity[c].values();
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += dt * rate[i];
  }
  now.projection.filter(flow.velocity);  // of the divergence that (8), of the increment, cannot see
  if (!std::isfinite(kinetic_energy(flow, now.gas.density)))
    throw NumericalError(
        (std::ostringstream() << "gas flow: the velocity is not finite after a step of " << dt << " s")
            .str());
  now.times.lap("projections");
}

const StageTimes& NavierStokes::times() const {
  return implementation_->times;
}

/// The wide_mean() of cells on every face across axis c that an owned cell has. Collective.
void NavierStokes::Implementation::mean_on_faces(const grid::Field& u, int c, BlockArray& face) {
  const BlockLayout layout(grid);
  const Index3 n = grid.cells();
  const auto take_mean = [&](int j, int k, int n_faces) {
    const double *before = window.row(j, k, c, -2), *lower = window.row(j, k, c, -1),
                 *upper = window.row(j, k), *after = window.row(j, k, c, 1);
    double* normal = face.first() + layout.offset(0, j, k - grid.z_begin());
#pragma GCC ivdep
    for (int i = 0; i < n_faces; ++i) normal[i] = wide_mean(before[i], lower[i], upper[i], after[i]);
  };
  window.open(u);
  for (int k = grid.z_begin(); k < grid.z_end(); ++k) {
    window.move_to(k);
    for (int j = 0; j < (c == 1 ? n.j + 1 : n.j); ++j) take_mean(j, k, c == 0 ? n.i + 1 : n.i);
  }
  for (int j = 0; c == 2 && j < n.j; ++j) take_mean(j, grid.z_end(), n.i);
}

void NavierStokes::film_velocity(const state::GasFlow& flow, grid::VectorField& on_faces) {
  Implementation& now = *implementation_;
  const BlockLayout layout(now.grid);
  BlockVector& face = now.godunov.face_velocity();
  for (int c = 0; c < 3; ++c) now.mean_on_faces(flow.velocity[c], c, face[c]);
  now.projection.clear_divergence(face);
  for (int c = 0; c < 3; ++c) {
    const double* normal = face[c].first();
    double* to = on_faces[c].values().data();
    for_each_owned_row(layout, layout.owned(),
                       [=](std::ptrdiff_t row, std::ptrdiff_t place, std::ptrdiff_t n) {
                         std::copy(normal + row, normal + row + n, to + place);
                       });
  }
  now.times.lap("velocity of films");
}

StepLimit NavierStokes::advection_limit(const state::GasFlow& flow, double cfl) const {
  const double speed = max_speed(flow);
  const double dt =
      speed > 0 ? cfl * implementation_->grid.h() / speed : std::numeric_limits<double>::infinity();
  return {dt, "advection"};
}

StepLimit capillary_limit(double h, const state::Materials& materials, double factor) {
  const double rho = materials.gas.density;             // ρ [kg/m³]
  const double sigma = materials.film.surface_tension;  // σ [N/m]
  return {factor * std::sqrt(rho * h * h * h / (2 * sigma)), "capillary waves"};
}

double kinetic_energy(const state::GasFlow& flow, double density) {
  double sum_of_squares = 0;
  for (const grid::Field& component : flow.velocity.components)
    sum_of_squares += grid::sum_of_squares(component);
  return 0.5 * density * std::pow(flow.pressure.grid().h(), 3) * sum_of_squares;
}

double max_speed(const state::GasFlow& flow) {
  const std::span<const double> u = flow.velocity[0].values(), v = flow.velocity[1].values(),
                                w = flow.velocity[2].values();
  double largest = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    largest = std::max(largest, u[i] * u[i] + v[i] * v[i] + w[i] * w[i]);
  return std::sqrt(flow.pressure.grid().communicator().max(largest));
}

}  // namespace spume::flow
