#include "spume/flow/crank_nicolson.hpp"

#include "spume/flow/wide_mean.hpp"

namespace spume::flow {

void explicit_acceleration(const grid::Grid& grid, const state::Gas& gas, int component,
                           const GhostedField& u, const GhostedField& pressure,
                           const GhostedField& body_force, BlockArray& acceleration) {
  const BlockLayout layout(grid);
  const double h = grid.h();
  const double nu = gas.viscosity / gas.density;  // ν [m²/s]
  const double viscous = nu / (h * h);
  const double per_density = 1 / gas.density;
  const double gradient = 1 / (h * gas.density);
  const std::ptrdiff_t s = layout.stride(component), sy = layout.stride(1), sz = layout.stride(2);
  const double *v = first(u, grid), *f = first(body_force, grid), *p = first(pressure, grid);
  double* a = acceleration.first();
  for_each_row(layout, layout.owned().grown(1), [=](std::ptrdiff_t row, std::ptrdiff_t n) {
#pragma GCC ivdep
    for (std::ptrdiff_t c = row; c < row + n; ++c) {
      const double neighbours = v[c - 1] + v[c + 1] + v[c - sy] + v[c + sy] + v[c - sz] + v[c + sz];
      a[c] = viscous * (neighbours - 6 * v[c]) + per_density * f[c] -
             gradient * wide_difference(p[c - 2 * s], p[c - s], p[c + s], p[c + 2 * s]);
    }
  });
}

void diffuse_implicitly(grid::EllipticSolver& elliptic, const state::Gas& gas, double dt,
                        grid::VectorField& rate) {
  const double nu = gas.viscosity / gas.density;  // ν [m²/s]
  if (nu == 0) return;
  for (grid::Field& component : rate.components) elliptic.solve(1, 0.5 * nu * dt, component, component);
}

}  // namespace spume::flow
