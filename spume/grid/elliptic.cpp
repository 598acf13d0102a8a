#include "spume/grid/elliptic.hpp"

#include <cmath>

#include "spume/base/contract.hpp"
#include "spume/grid/elliptic_multigrid.hpp"
#include "spume/grid/implementation.hpp"

namespace spume::grid {

namespace {

/// Eigenvalues (2 − 2cos θ)/h² = (2 sin(θ/2)/h)² of −∂²/∂x_d² as three points see it; the second form keeps
/// its precision for small θ.
std::vector<double> laplacian_eigenvalues(std::span<const double> theta, double h) {
  std::vector<double> eigenvalues;
  for (const double angle : theta) eigenvalues.push_back(std::pow(2 * std::sin(angle / 2) / h, 2));
  return eigenvalues;
}

void solve_trigonometric(double a, double b, const Field& f, Field& x) {
  const Grid& grid = x.grid();
  Transform& transform = transform_of(grid, x.symmetry());
  const std::vector<double> lambda_x = laplacian_eigenvalues(transform.theta(0), grid.h());
  const std::vector<double> lambda_y = laplacian_eigenvalues(transform.theta(1), grid.h());
  const std::vector<double> lambda_z = laplacian_eigenvalues(transform.theta(2), grid.h());
  std::vector<double> factor(lambda_x.size());
  transform.filter(f, x, [&](int row) {
    const double lambda_yz = lambda_y[transform.mode_y(row)] + lambda_z[transform.mode_z(row)];
    for (std::size_t m = 0; m < factor.size(); ++m)
      factor[m] = transform.normalisation() / (a + b * (lambda_x[m] + lambda_yz));
    const bool mean_mode = lambda_x[0] == 0 && lambda_yz == 0;
    if (mean_mode && a == 0) factor[0] = 0;
    return factor.data();
  });
}

}  // namespace

struct EllipticSolver::Implementation {
  const Grid* grid;
  EllipticBackend backend;
  MultigridSolver multigrid;
};

EllipticSolver::EllipticSolver(const Grid& grid, EllipticBackend backend, double tolerance)
    : implementation_(new Implementation{&grid, backend, MultigridSolver(grid, tolerance)}) {}

EllipticSolver::~EllipticSolver() = default;
EllipticSolver::EllipticSolver(EllipticSolver&&) noexcept = default;

void EllipticSolver::solve(double a, double b, const Field& f, Field& x) {
  expects(a >= 0 && b > 0, "elliptic problems have a >= 0 and b > 0");
  expects(&f.grid() == implementation_->grid && &x.grid() == implementation_->grid,
          "a solver works on fields of its grid");
  if (implementation_->backend == EllipticBackend::Trigonometric)
    solve_trigonometric(a, b, f, x);
  else
    implementation_->multigrid.solve(a, b, f, x);
}

}  // namespace spume::grid
