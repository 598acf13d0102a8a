#include "spume/grid/elliptic_multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/grid/implementation.hpp"
#include "spume/grid/loops.hpp"

namespace spume::grid {

namespace {

using parallel::petsc_check;
using Matrix = parallel::PetscOwner<Mat, MatDestroy>;
using Vector = parallel::PetscOwner<Vec, VecDestroy>;

constexpr std::size_t systems_kept = 8;
constexpr int max_coarsest_cells = 64;  // solved by a dense singular value decomposition
constexpr int max_iterations = 200;

/// The cells of one level: their centres along each axis in units of the fine cell edge, and the layers this
/// rank holds.
struct Level {
  std::array<std::vector<double>, 3> centre;
  int z_begin, z_end;

  int n(int axis) const { return static_cast<int>(centre[axis].size()); }
  PetscInt layer() const { return n(0) * n(1); }
  PetscInt owned() const { return layer() * (z_end - z_begin); }
  PetscInt total() const { return layer() * n(2); }
};

Level finest_level(const Grid& grid) {
  Level level;
  for (int axis = 0; axis < 3; ++axis)
    for (int m = 0; m < grid.cells()[axis]; ++m) level.centre[axis].push_back(m + 0.5);
  level.z_begin = grid.z_begin();
  level.z_end = grid.z_end();
  return level;
}

/// Joins cells 2m and 2m+1 along every axis. A coarse cell belongs to the rank of its first fine cell.
Level coarsen(const Level& fine, const Index3& fine_cells) {
  Level coarse;
  for (int axis = 0; axis < 3; ++axis) {
    // Faces follow from the finest grid: coarse cell m of a level with edge e spans e·m … min(e·(m+1), n).
    const int n = fine.n(axis), n_coarse = (n + 1) / 2;
    const double edge = n == 1 ? 0 : 4 * fine.centre[axis][0];
    for (int m = 0; m < n_coarse; ++m) {
      const double upper = std::min<double>(edge * (m + 1), fine_cells[axis]);
      coarse.centre[axis].push_back(n == 1 ? fine.centre[axis][0] : 0.5 * (edge * m + upper));
    }
  }
  coarse.z_begin = (fine.z_begin + 1) / 2;
  coarse.z_end = (fine.z_end + 1) / 2;
  return coarse;
}

/// Value of a fine cell from two coarse ones along one axis.
struct Interpolation {
  std::array<int, 2> cell;
  std::array<double, 2> weight;
};

std::vector<Interpolation> interpolate(const std::vector<double>& fine, const std::vector<double>& coarse,
                                       int n, Boundary boundary, Parity parity) {
  const int n_coarse = static_cast<int>(coarse.size());
  const bool periodic = boundary == Boundary::Periodic;
  // The ghost beyond either end: a periodic image, or the mirror image at the wall.
  const double below = periodic ? coarse.back() - n : -coarse.front();
  const double above = periodic ? coarse.front() + n : 2.0 * n - coarse.back();
  const double sign = !periodic && parity == Parity::Odd ? -1 : 1;
  std::vector<Interpolation> result;
  for (const double x : fine) {
    const int right = static_cast<int>(std::upper_bound(coarse.begin(), coarse.end(), x) - coarse.begin());
    const double x_left = right == 0 ? below : coarse[right - 1];
    const double x_right = right == n_coarse ? above : coarse[right];
    const double t = (x - x_left) / (x_right - x_left);
    const int left_cell = right > 0 ? right - 1 : periodic ? n_coarse - 1 : 0;
    const int right_cell = right < n_coarse ? right : periodic ? 0 : n_coarse - 1;
    result.push_back(
        {{left_cell, right_cell}, {right == 0 ? sign * (1 - t) : 1 - t, right == n_coarse ? sign * t : t}});
  }
  return result;
}

Matrix make_matrix(MPI_Comm comm, PetscInt rows, PetscInt columns, PetscInt nonzeros_per_row) {
  Matrix matrix;
  petsc_check(MatCreateAIJ(comm, rows, columns, PETSC_DETERMINE, PETSC_DETERMINE, nonzeros_per_row, nullptr,
                           nonzeros_per_row, nullptr, matrix.out()));
  return matrix;
}

void assemble(Mat matrix) {
  petsc_check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  petsc_check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

Matrix interpolation_matrix(const Grid& grid, const Level& fine, const Level& coarse,
                            const Symmetry& symmetry) {
  std::array<std::vector<Interpolation>, 3> along;
  for (int axis = 0; axis < 3; ++axis)
    along[axis] = interpolate(fine.centre[axis], coarse.centre[axis], grid.cells()[axis],
                              grid.box().boundary[axis], symmetry[axis]);
  Matrix matrix = make_matrix(grid.communicator().handle(), fine.owned(), coarse.owned(), 8);
  for (int k = fine.z_begin; k < fine.z_end; ++k)
    for (int j = 0; j < fine.n(1); ++j)
      for (int i = 0; i < fine.n(0); ++i) {
        const PetscInt row = k * fine.layer() + j * fine.n(0) + i;
        std::array<PetscInt, 8> column;
        std::array<double, 8> weight;
        for (int corner = 0; corner < 8; ++corner) {
          const int cx = corner & 1, cy = corner >> 1 & 1, cz = corner >> 2;
          column[corner] = along[2][k].cell[cz] * coarse.layer() + along[1][j].cell[cy] * coarse.n(0) +
                           along[0][i].cell[cx];
          weight[corner] = along[2][k].weight[cz] * along[1][j].weight[cy] * along[0][i].weight[cx];
        }
        // Two corners may be one cell, beside walls and on coarse periodic levels: their weights add.
        petsc_check(MatSetValues(matrix.get(), 1, &row, 8, column.data(), weight.data(), ADD_VALUES));
      }
  assemble(matrix.get());
  return matrix;
}

/// The equation is divided by this, the diagonal far from walls: PETSc's dense solver takes singular values
/// below 1e-12 for zero, whatever the units.
double diagonal_scale(const Grid& grid, double a, double b) {
  return a + 6 * b / (grid.h() * grid.h());
}

/// a − b ∇²_h, scaled: the seven-point operator with mirror ghosts eliminated.
Matrix operator_matrix(const Grid& grid, double a, double b, const Symmetry& symmetry) {
  const Index3 n = grid.cells();
  const Index3 stride{1, n.i, n.i * n.j};
  const double coupling = b / (grid.h() * grid.h()) / diagonal_scale(grid, a, b);
  const auto owned = static_cast<PetscInt>(grid.owned_size());
  Matrix matrix = make_matrix(grid.communicator().handle(), owned, owned, 7);
  for_each_cell(grid, [&](int i, int j, int k) {
    const Index3 cell{i, j, k};
    const PetscInt row = k * stride.k + j * stride.j + i;
    std::array<PetscInt, 7> column;
    std::array<double, 7> value;
    int m = 0;
    double diagonal = 1;
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        const int neighbour = cell[axis] + side;
        if (neighbour >= 0 && neighbour < n[axis]) {
          column[m] = row + side * stride[axis];
          value[m++] = -coupling;
        } else if (grid.box().boundary[axis] == Boundary::Periodic) {
          column[m] = row - side * (n[axis] - 1) * stride[axis];
          value[m++] = -coupling;
        } else {
          diagonal -= symmetry[axis] == Parity::Even ? coupling : -coupling;
        }
      }
    column[m] = row;
    value[m++] = diagonal;
    petsc_check(MatSetValues(matrix.get(), 1, &row, m, column.data(), value.data(), INSERT_VALUES));
  });
  assemble(matrix.get());
  return matrix;
}

/// Tells the Krylov method that constants are the null space.
void attach_constants(Mat matrix, MPI_Comm comm) {
  parallel::PetscOwner<MatNullSpace, MatNullSpaceDestroy> constants;
  petsc_check(MatNullSpaceCreate(comm, PETSC_TRUE, 0, nullptr, constants.out()));
  petsc_check(MatSetNullSpace(matrix, constants.get()));
}

/// Interpolations from coarsest to finest.
std::vector<Matrix> make_interpolations(const Grid& grid, const Symmetry& symmetry) {
  std::vector<Matrix> interpolations;
  Level fine = finest_level(grid);
  while (fine.total() > max_coarsest_cells) {
    Level coarse = coarsen(fine, grid.cells());
    interpolations.push_back(interpolation_matrix(grid, fine, coarse, symmetry));
    fine = std::move(coarse);
  }
  std::reverse(interpolations.begin(), interpolations.end());
  return interpolations;
}

/// Galerkin products from coarsest to finest, the finest given.
std::vector<Matrix> make_operators(Matrix finest, const std::vector<Matrix>& interpolations) {
  std::vector<Matrix> operators(interpolations.size() + 1);
  operators.back() = std::move(finest);
  for (std::size_t level = interpolations.size(); level > 0; --level)
    petsc_check(MatPtAP(operators[level].get(), interpolations[level - 1].get(), MAT_INITIAL_MATRIX,
                        PETSC_DEFAULT, operators[level - 1].out()));
  return operators;
}

/// Upper bound of the eigenvalues of the operator scaled by its diagonal: max over rows of Σ|a_ij|/a_ii
/// (Gershgorin).
double largest_eigenvalue_bound(Mat matrix, const parallel::Communicator& communicator) {
  PetscInt begin = 0, end = 0;
  petsc_check(MatGetOwnershipRange(matrix, &begin, &end));
  double bound = 0;
  for (PetscInt row = begin; row < end; ++row) {
    PetscInt n = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    petsc_check(MatGetRow(matrix, row, &n, &columns, &values));
    double row_sum = 0, diagonal = 0;
    for (PetscInt m = 0; m < n; ++m) {
      row_sum += std::abs(values[m]);
      if (columns[m] == row) diagonal = values[m];
    }
    bound = std::max(bound, row_sum / diagonal);
    petsc_check(MatRestoreRow(matrix, row, &n, &columns, &values));
  }
  return communicator.max(bound);
}

/// Two Chebyshev–Jacobi sweeps before and after the coarser level, over the upper part of the spectrum, which
/// that level does not represent.
void set_smoother(PC multigrid, int level, Mat matrix, const parallel::Communicator& communicator) {
  KSP smoother;
  PC jacobi;
  const double bound = largest_eigenvalue_bound(matrix, communicator);
  petsc_check(PCMGGetSmoother(multigrid, level, &smoother));
  petsc_check(KSPSetOperators(smoother, matrix, matrix));
  petsc_check(KSPSetType(smoother, KSPCHEBYSHEV));
  petsc_check(KSPChebyshevSetEigenvalues(smoother, bound, 0.15 * bound));
  petsc_check(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, 2));
  petsc_check(KSPSetNormType(smoother, KSP_NORM_NONE));
  petsc_check(KSPGetPC(smoother, &jacobi));
  petsc_check(PCSetType(jacobi, PCJACOBI));
}

/// The coarsest level on every rank at once, by a singular value decomposition, which takes singular
/// operators.
void set_coarsest(PC multigrid, Mat matrix) {
  KSP coarsest, inner;
  PC redundant, decomposition;
  petsc_check(PCMGGetCoarseSolve(multigrid, &coarsest));
  petsc_check(KSPSetOperators(coarsest, matrix, matrix));
  petsc_check(KSPSetType(coarsest, KSPPREONLY));
  petsc_check(KSPGetPC(coarsest, &redundant));
  petsc_check(PCSetType(redundant, PCREDUNDANT));
  petsc_check(PCRedundantGetKSP(redundant, &inner));
  petsc_check(KSPSetType(inner, KSPPREONLY));
  petsc_check(KSPGetPC(inner, &decomposition));
  petsc_check(PCSetType(decomposition, PCSVD));
}

}  // namespace

MultigridSolver::System MultigridSolver::make_system(double a, double b, const Symmetry& symmetry) const {
  const MPI_Comm comm = grid_->communicator().handle();
  const auto& boundary = grid_->box().boundary;
  System system{a, b, symmetry, a == 0, {}, {}, {}};
  for (int axis = 0; axis < 3; ++axis)
    if (boundary[axis] != Boundary::Periodic && symmetry[axis] == Parity::Odd) system.singular = false;

  const std::vector<Matrix> interpolations = make_interpolations(*grid_, symmetry);
  const std::vector<Matrix> operators =
      make_operators(operator_matrix(*grid_, a, b, symmetry), interpolations);
  const int n_levels = static_cast<int>(operators.size());
  const Mat finest = operators.back().get();
  if (system.singular) attach_constants(finest, comm);

  PC multigrid;
  petsc_check(KSPCreate(comm, system.krylov.out()));
  const KSP krylov = system.krylov.get();
  petsc_check(KSPSetType(krylov, KSPCG));
  petsc_check(KSPSetNormType(krylov, KSP_NORM_UNPRECONDITIONED));
  petsc_check(KSPSetTolerances(krylov, tolerance_, 0.0, PETSC_DEFAULT, max_iterations));
  petsc_check(KSPSetOperators(krylov, finest, finest));
  petsc_check(KSPGetPC(krylov, &multigrid));
  petsc_check(PCSetType(multigrid, PCMG));
  petsc_check(PCMGSetLevels(multigrid, n_levels, nullptr));
  for (int level = 1; level < n_levels; ++level) {
    petsc_check(PCMGSetInterpolation(multigrid, level, interpolations[level - 1].get()));
    set_smoother(multigrid, level, operators[level].get(), grid_->communicator());
  }
  set_coarsest(multigrid, operators.front().get());
  petsc_check(KSPSetUp(krylov));

  const auto owned = static_cast<PetscInt>(grid_->owned_size());
  petsc_check(VecCreateMPI(comm, owned, PETSC_DETERMINE, system.right_side.out()));
  petsc_check(VecCreateMPIWithArray(comm, 1, owned, PETSC_DETERMINE, nullptr, system.solution.out()));
  return system;
}

MultigridSolver::System& MultigridSolver::system(double a, double b, const Symmetry& symmetry) {
  const auto found = std::find_if(systems_.begin(), systems_.end(), [&](const System& s) {
    return s.a == a && s.b == b && s.symmetry == symmetry;
  });
  if (found != systems_.end()) {
    systems_.splice(systems_.begin(), systems_, found);
  } else {
    if (systems_.size() == systems_kept) systems_.pop_back();
    systems_.push_front(make_system(a, b, symmetry));
  }
  return systems_.front();
}

void MultigridSolver::solve(double a, double b, const Field& f, Field& x) {
  System& s = system(a, b, effective_symmetry(grid_->box(), x.symmetry()));
  const double mean = s.singular ? sum(f) / static_cast<double>(grid_->total_size()) : 0.0;
  const double scale = diagonal_scale(*grid_, a, b);
  double* right_side = nullptr;
  petsc_check(VecGetArrayWrite(s.right_side.get(), &right_side));
  std::transform(f.values().begin(), f.values().end(), right_side,
                 [&](double value) { return (value - mean) / scale; });
  petsc_check(VecRestoreArrayWrite(s.right_side.get(), &right_side));

  petsc_check(VecPlaceArray(s.solution.get(), x.values().data()));
  petsc_check(KSPSolve(s.krylov.get(), s.right_side.get(), s.solution.get()));
  petsc_check(VecResetArray(s.solution.get()));

  KSPConvergedReason reason;
  petsc_check(KSPGetConvergedReason(s.krylov.get(), &reason));
  if (reason <= 0) {
    PetscInt iterations = 0;
    double residual = 0;
    petsc_check(KSPGetIterationNumber(s.krylov.get(), &iterations));
    petsc_check(KSPGetResidualNorm(s.krylov.get(), &residual));
    std::ostringstream message;
    message << "multigrid: no convergence to relative residual " << tolerance_ << " ("
            << KSPConvergedReasons[reason] << " after " << iterations << " iterations, residual " << residual
            << ")";
    throw NumericalError(message.str());
  }
  if (s.singular) {
    const double mean_x = sum(x) / static_cast<double>(grid_->total_size());
    for (double& value : x.values()) value -= mean_x;
  }
}

}  // namespace spume::grid
