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
    : grid_(grid), elliptic_(elliptic), layout_(grid), potential_(grid), ghosted_(potential_) {}

void Projection::clear_divergence(BlockVector& face_velocity) {
  double* rhs = potential_.values().data();
  for_each_divergence(grid_, layout_, face_velocity,
                      [=](std::ptrdiff_t c, double value) { rhs[c] = -value; });
  elliptic_.solve(0, 1, potential_, potential_);
  ghosted_.update(potential_);
  const double per_h = 1 / grid_.h();
  for (int axis = 0; axis < 3; ++axis) {
    double* normal = face_velocity[axis].first();
    const std::array<std::ptrdiff_t, 3> stride{1, ghosted_.stride_y(), ghosted_.stride_z()};
    const std::ptrdiff_t s = stride[axis];
    const CellRange faces = layout_.owned_faces(axis);
    for (int k = faces.lower.k; k < faces.upper.k; ++k)
      for (int j = faces.lower.j; j < faces.upper.j; ++j) {
        const double* phi = ghosted_.at(0, j, k + grid_.z_begin());
        double* u = normal + layout_.offset(0, j, k);
#pragma GCC ivdep
        for (int i = 0; i < faces.upper.i; ++i) u[i] -= per_h * (phi[i] - phi[i - s]);
      }
  }
}

/// Subtracts Gφ with ∇²_h φ = D x from x, and leaves φ in potential_.
void Projection::remove_gradient(grid::VectorField& x) {
  const Index3 n = grid_.cells();
  const double half_per_h = 0.5 / grid_.h();
  const std::ptrdiff_t sy = ghosted_.stride_y(), sz = ghosted_.stride_z();
  const auto for_rows = [&](auto&& body) {
    std::ptrdiff_t place = 0;
    for (int k = grid_.z_begin(); k < grid_.z_end(); ++k)
      for (int j = 0; j < n.j; ++j, place += n.i) body(j, k, place);
  };

  double* source = potential_.values().data();
  const std::array<std::ptrdiff_t, 3> stride{1, sy, sz};
  for (int c = 0; c < 3; ++c) {
    ghosted_.update(x[c]);
    const std::ptrdiff_t step = stride[c];
    for_rows([&](int j, int k, std::ptrdiff_t place) {
      const double* v = ghosted_.at(0, j, k);
      double* row = source + place;
#pragma GCC ivdep
      for (int i = 0; i < n.i; ++i)
        row[i] = (c == 0 ? 0.0 : row[i]) - half_per_h * (v[i + step] - v[i - step]);
    });
  }
  elliptic_.solve(0, 1, potential_, potential_);
  ghosted_.update(potential_);

  double *first = x[0].values().data(), *second = x[1].values().data(), *third = x[2].values().data();
  for_rows([&](int j, int k, std::ptrdiff_t place) {
    const double* phi = ghosted_.at(0, j, k);
    double *u = first + place, *v = second + place, *w = third + place;
#pragma GCC ivdep
    for (int i = 0; i < n.i; ++i) {
      u[i] -= half_per_h * (phi[i + 1] - phi[i - 1]);
      v[i] -= half_per_h * (phi[i + sy] - phi[i - sy]);
      w[i] -= half_per_h * (phi[i + sz] - phi[i - sz]);
    }
  });
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
