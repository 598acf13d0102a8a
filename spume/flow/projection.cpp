#include "spume/flow/projection.hpp"

#include <algorithm>
#include <cmath>

#include "spume/flow/wide_mean.hpp"

namespace spume::flow {

namespace {

/// Calls body(place, divergence) for every owned cell, at its place in the values of a Field.
template <class Body>
void for_each_divergence(const grid::Grid& grid, const BlockLayout& layout, const BlockVector& face_velocity,
                         Body&& body) {
  const double *x = face_velocity[0].first(), *y = face_velocity[1].first(), *z = face_velocity[2].first();
  const std::ptrdiff_t sy = layout.stride(1), sz = layout.stride(2);
  const double per_h = 1 / grid.h();
  for_each_owned_row(layout, layout.owned(), [&](std::ptrdiff_t row, std::ptrdiff_t place, std::ptrdiff_t n) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const std::ptrdiff_t c = row + i;
      body(place + i, per_h * (x[c + 1] - x[c] + y[c + sy] - y[c] + z[c + sz] - z[c]));
    }
  });
}

}  // namespace

Projection::Projection(const grid::Grid& grid, grid::EllipticSolver& elliptic)
    : grid_(grid),
      elliptic_(elliptic),
      layout_(grid),
      potential_(grid),
      phi_(grid, 2),
      x_{grid::LayerWindow(grid, 2), grid::LayerWindow(grid, 2), grid::LayerWindow(grid, 2)} {}

void Projection::clear_divergence(BlockVector& face_velocity) {
  double* rhs = potential_.values().data();
  for_each_divergence(grid_, layout_, face_velocity,
                      [=](std::ptrdiff_t c, double value) { rhs[c] = -value; });
  elliptic_.solve(0, 1, potential_, potential_);
  const Index3 n = grid_.cells();
  const double per_h = 1 / grid_.h();
  const auto subtract = [&](int axis, int j, int k, int n_faces, const double* phi, const double* lower) {
    double* u = face_velocity[axis].first() + layout_.offset(0, j, k - grid_.z_begin());
#pragma GCC ivdep
    for (int i = 0; i < n_faces; ++i) u[i] -= per_h * (phi[i] - lower[i]);
  };
  phi_.open(potential_);
  for (int k = grid_.z_begin(); k < grid_.z_end(); ++k) {
    phi_.move_to(k);
    for (int j = 0; j < n.j; ++j) {
      const double* phi = phi_.row(j, k);
      subtract(0, j, k, n.i + 1, phi, phi - 1);
      subtract(1, j, k, n.i, phi, phi_.row(j - 1, k));
      subtract(2, j, k, n.i, phi, phi_.row(j, k - 1));
    }
    subtract(1, n.j, k, n.i, phi_.row(n.j, k), phi_.row(n.j - 1, k));
  }
  for (int j = 0; j < n.j; ++j)
    subtract(2, j, grid_.z_end(), n.i, phi_.row(j, grid_.z_end()), phi_.row(j, grid_.z_end() - 1));
}

/// Subtracts Gφ with ∇²_h φ = D x from x, and leaves φ in potential_.
void Projection::remove_gradient(grid::VectorField& x) {
  const Index3 n = grid_.cells();
  const double per_h = 1 / grid_.h();
  double* source = potential_.values().data();
  for (int c = 0; c < 3; ++c) x_[c].open(x[c]);
  for (int k = grid_.z_begin(); k < grid_.z_end(); ++k) {
    for (grid::LayerWindow& window : x_) window.move_to(k);
    for (int j = 0; j < n.j; ++j, source += n.i) {
      const double* u = x_[0].row(j, k);
      const auto v = [&](int d) { return x_[1].row(j + d, k); };
      const auto w = [&](int d) { return x_[2].row(j, k + d); };
      const double *v_2 = v(-2), *v_1 = v(-1), *v1 = v(1), *v2 = v(2), *w_2 = w(-2), *w_1 = w(-1), *w1 = w(1),
                   *w2 = w(2);
#pragma GCC ivdep
      for (int i = 0; i < n.i; ++i)
        source[i] = -per_h * (wide_difference(u[i - 2], u[i - 1], u[i + 1], u[i + 2]) +
                              wide_difference(v_2[i], v_1[i], v1[i], v2[i]) +
                              wide_difference(w_2[i], w_1[i], w1[i], w2[i]));
    }
  }
  elliptic_.solve(0, 1, potential_, potential_);

  double *u = x[0].values().data(), *v = x[1].values().data(), *w = x[2].values().data();
  phi_.open(potential_);
  for (int k = grid_.z_begin(); k < grid_.z_end(); ++k) {
    phi_.move_to(k);
    for (int j = 0; j < n.j; ++j, u += n.i, v += n.i, w += n.i) {
      const double* phi = phi_.row(j, k);
      const auto y = [&](int d) { return phi_.row(j + d, k); };
      const auto z = [&](int d) { return phi_.row(j, k + d); };
      const double *y_2 = y(-2), *y_1 = y(-1), *y1 = y(1), *y2 = y(2), *z_2 = z(-2), *z_1 = z(-1), *z1 = z(1),
                   *z2 = z(2);
#pragma GCC ivdep
      for (int i = 0; i < n.i; ++i) {
        u[i] -= per_h * wide_difference(phi[i - 2], phi[i - 1], phi[i + 1], phi[i + 2]);
        v[i] -= per_h * wide_difference(y_2[i], y_1[i], y1[i], y2[i]);
        w[i] -= per_h * wide_difference(z_2[i], z_1[i], z1[i], z2[i]);
      }
    }
  }
}

void Projection::project(double density, grid::VectorField& rate, grid::Field& pressure) {
  remove_gradient(rate);
  const std::span<const double> phi = potential_.values();
  const std::span<double> p = pressure.values();
  for (std::size_t i = 0; i < p.size(); ++i) p[i] += density * phi[i];  // ψ = ρφ
}

void Projection::filter(grid::VectorField& velocity) {
  remove_gradient(velocity);
}

double max_divergence(const grid::Grid& grid, const BlockVector& face_velocity) {
  double largest = 0;
  for_each_divergence(grid, BlockLayout(grid), face_velocity,
                      [&](std::ptrdiff_t, double value) { largest = std::max(largest, std::abs(value)); });
  return grid.communicator().max(largest);
}

}  // namespace spume::flow
