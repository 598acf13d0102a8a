#include "spume/flow/projection.hpp"

#include <algorithm>
#include <cmath>

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
      phi_(grid),
      x_{grid::LayerWindow(grid), grid::LayerWindow(grid), grid::LayerWindow(grid)} {}

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
  const double half_per_h = 0.5 / grid_.h();
  double* source = potential_.values().data();
  for (int c = 0; c < 3; ++c) x_[c].open(x[c]);
  for (int k = grid_.z_begin(); k < grid_.z_end(); ++k) {
    for (grid::LayerWindow& window : x_) window.move_to(k);
    for (int j = 0; j < n.j; ++j, source += n.i) {
      const double *u = x_[0].row(j, k), *v_below = x_[1].row(j - 1, k), *v_above = x_[1].row(j + 1, k),
                   *w_below = x_[2].row(j, k - 1), *w_above = x_[2].row(j, k + 1);
#pragma GCC ivdep
      for (int i = 0; i < n.i; ++i)
        source[i] =
            -half_per_h * (u[i + 1] - u[i - 1] + (v_above[i] - v_below[i]) + (w_above[i] - w_below[i]));
    }
  }
  elliptic_.solve(0, 1, potential_, potential_);

  double *u = x[0].values().data(), *v = x[1].values().data(), *w = x[2].values().data();
  phi_.open(potential_);
  for (int k = grid_.z_begin(); k < grid_.z_end(); ++k) {
    phi_.move_to(k);
    for (int j = 0; j < n.j; ++j, u += n.i, v += n.i, w += n.i) {
      const double *phi = phi_.row(j, k), *below_y = phi_.row(j - 1, k), *above_y = phi_.row(j + 1, k),
                   *below_z = phi_.row(j, k - 1), *above_z = phi_.row(j, k + 1);
#pragma GCC ivdep
      for (int i = 0; i < n.i; ++i) {
        u[i] -= half_per_h * (phi[i + 1] - phi[i - 1]);
        v[i] -= half_per_h * (above_y[i] - below_y[i]);
        w[i] -= half_per_h * (above_z[i] - below_z[i]);
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
