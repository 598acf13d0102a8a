#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "spume/grid/loops.hpp"
#include "spume/state/gas_flow.hpp"

namespace spume::verification {

/// A solution of the Navier–Stokes equations in closed form.
struct ExactFlow {
  std::function<Vec3(const Vec3& x, double t)> velocity;
  std::function<double(const Vec3& x, double t)> pressure;  ///< of mean zero over its period
};

/// Taylor–Green vortices of wave number k in the plane across `axis`, decaying with exp(−2νk²t) and carried
/// by `mean`: with a, b the coordinates of the plane in cyclic order,
///   u_a = U sin ka cos kb,  u_b = −U cos ka sin kb,  p = ¼ρU² (cos 2ka + cos 2kb).
inline ExactFlow taylor_green(int axis, double k, double speed, double nu, double rho,
                              const Vec3& mean = {}) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  return {[=](const Vec3& x, double t) {
            const Vec3 y = x - t * mean;
            const double amplitude = speed * std::exp(-2 * nu * k * k * t);
            Vec3 u = mean;
            u[a] += amplitude * std::sin(k * y[a]) * std::cos(k * y[b]);
            u[b] -= amplitude * std::cos(k * y[a]) * std::sin(k * y[b]);
            return u;
          },
          [=](const Vec3& x, double t) {
            const Vec3 y = x - t * mean;
            const double amplitude = speed * std::exp(-2 * nu * k * k * t);
            return 0.25 * rho * amplitude * amplitude * (std::cos(2 * k * y[a]) + std::cos(2 * k * y[b]));
          }};
}

/// The Arnold–Beltrami–Childress flow with equal coefficients, in which every component varies along two
/// directions, decaying with exp(−νk²t) and carried by `mean`. Its vorticity is k times its velocity, so p =
/// −½ρ|u|² + const.
inline ExactFlow beltrami(double k, double speed, double nu, double rho, const Vec3& mean = {}) {
  const auto swirl = [=](const Vec3& x, double t) {
    const Vec3 y = k * (x - t * mean);
    return speed * std::exp(-nu * k * k * t) *
           Vec3{std::sin(y.z) + std::cos(y.y), std::sin(y.x) + std::cos(y.z), std::sin(y.y) + std::cos(y.x)};
  };
  return {[=](const Vec3& x, double t) { return mean + swirl(x, t); },
          [=](const Vec3& x, double t) {
            const double mean_square = 3 * std::pow(speed * std::exp(-nu * k * k * t), 2);
            return -0.5 * rho * (norm_squared(swirl(x, t)) - mean_square);
          }};
}

inline void set_velocity(grid::VectorField& u, const std::function<Vec3(const Vec3&)>& value) {
  const grid::Grid& grid = u[0].grid();
  for (int c = 0; c < 3; ++c) {
    const grid::OwnedView view = owned(u[c]);
    for_each_cell(grid, [&](int i, int j, int k) { view(i, j, k) = value(grid.centre(i, j, k))[c]; });
  }
}

/// Root mean square over the cells of |u − exact| [m/s]. Collective.
inline double velocity_error(const grid::VectorField& u, const std::function<Vec3(const Vec3&)>& exact) {
  const grid::Grid& grid = u[0].grid();
  grid::VectorField difference(grid);
  set_velocity(difference, exact);
  double sum_of_squares = 0;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < u[c].values().size(); ++i)
      sum_of_squares += std::pow(u[c].values()[i] - difference[c].values()[i], 2);
  return std::sqrt(grid.communicator().sum(sum_of_squares) / static_cast<double>(grid.total_size()));
}

/// Root mean square over the cells of a scalar less its exact value, means taken out. Collective.
inline double scalar_error(const grid::Field& f, const std::function<double(const Vec3&)>& exact) {
  const grid::Grid& grid = f.grid();
  grid::Field difference(grid);
  const grid::OwnedView view = owned(difference);
  for_each_cell(grid, [&](int i, int j, int k) { view(i, j, k) = exact(grid.centre(i, j, k)); });
  double total = 0, squares = 0;
  for (std::size_t i = 0; i < f.values().size(); ++i) {
    const double e = f.values()[i] - difference.values()[i];
    total += e;
    squares += e * e;
  }
  const auto n = static_cast<double>(grid.total_size());
  const double mean = grid.communicator().sum(total) / n;
  return std::sqrt(std::max(0.0, grid.communicator().sum(squares) / n - mean * mean));
}

}  // namespace spume::verification
