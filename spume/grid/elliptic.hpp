#pragma once

#include <memory>

#include "spume/grid/field.hpp"

namespace spume::grid {

enum class EllipticBackend {
  Trigonometric,  ///< FFTW: exact to round-off
  Multigrid,  ///< PETSc: conjugate gradients preconditioned by geometric multigrid, to a relative tolerance
};

/// Solves (a − b ∇²_h) x = f with constants a ≥ 0, b > 0 and the seven-point Laplacian
///   ∇²_h x = Σ_d (x_{+d} − 2x + x_{−d}) / h²,
/// ghosts of x by its symmetry (even: homogeneous Neumann; odd: homogeneous Dirichlet, both at the face of
/// the box). Where a = 0 and no direction is odd at a wall the operator has the constants in its null space:
/// the mean of f is dropped and x has mean zero. One solver keeps plans and hierarchies for every (a, b,
/// symmetry) it has met.
class EllipticSolver {
 public:
  /// `tolerance`: relative residual of the multigrid backend; the trigonometric one is exact.
  EllipticSolver(const Grid& grid, EllipticBackend backend, double tolerance = 1e-10);
  ~EllipticSolver();
  EllipticSolver(EllipticSolver&&) noexcept;

  /// Collective. `f` and `x` may be the same field; the symmetry is that of x.
  /// Throws NumericalError when the multigrid backend does not converge.
  void solve(double a, double b, const Field& f, Field& x);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace spume::grid
