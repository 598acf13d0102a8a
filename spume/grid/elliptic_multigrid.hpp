#pragma once

#include <petscksp.h>

#include <list>
#include <vector>

#include "spume/grid/field.hpp"
#include "spume/parallel/petsc.hpp"

// Internal to grid/: brings PETSc's headers.
namespace spume::grid {

/// (a − b ∇²_h) x = f by conjugate gradients preconditioned with one V-cycle of geometric multigrid (PETSc's
/// PCMG). Coarse cells join two cells along each direction (the last one is single where their number is
/// odd), the interpolation is trilinear between the centres of coarse cells, restriction is its transpose,
/// and the coarse operators are Galerkin products, so any number of cells and any mix of boundaries works.
/// Chebyshev–Jacobi smoothing keeps the preconditioner symmetric and independent of the number of ranks.
class MultigridSolver {
 public:
  MultigridSolver(const Grid& grid, double tolerance) : grid_(&grid), tolerance_(tolerance) {}

  /// Collective. See EllipticSolver::solve().
  void solve(double a, double b, const Field& f, Field& x);

 private:
  /// Everything that depends on the coefficients and the symmetry.
  struct System {
    double a, b;
    Symmetry symmetry;
    bool singular;
    parallel::PetscOwner<KSP, KSPDestroy> krylov;
    parallel::PetscOwner<Vec, VecDestroy> right_side, solution;
  };
  System& system(double a, double b, const Symmetry& symmetry);
  System make_system(double a, double b, const Symmetry& symmetry) const;

  const Grid* grid_;
  double tolerance_;
  std::list<System> systems_;  // most recently used first
};

}  // namespace spume::grid
