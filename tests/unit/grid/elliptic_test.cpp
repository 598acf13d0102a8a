#include "spume/grid/elliptic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "boxes.hpp"
#include "spume/base/error.hpp"

namespace spume::grid {
namespace {

using parallel::Communicator;

class EllipticOn : public testing::TestWithParam<NamedBox> {};
INSTANTIATE_TEST_SUITE_P(Boxes, EllipticOn, testing::ValuesIn(test_boxes()),
                         [](const auto& test) { return test.param.name; });

struct Coefficients {
  double a, b;
};
/// Poisson; a viscous step whose diffusion length sqrt(b/a) is 2 cells; one dominated by a.
std::vector<Coefficients> coefficients(double h) {
  return {{0, 1}, {1.2, 4.8 * h * h}, {1.2, 0.01 * h * h}};
}

bool is_singular(const Box& box, double a, const Symmetry& symmetry) {
  bool singular = a == 0;
  for (int axis = 0; axis < 3; ++axis)
    if (box.boundary[axis] != Boundary::Periodic && symmetry[axis] == Parity::Odd) singular = false;
  return singular;
}

/// f − (a − b ∇²_h) x, straight from the seven-point formula.
Field residual(double a, double b, const Field& f, const Field& x) {
  const Grid& grid = x.grid();
  const auto g = ghosted<1>(x);
  Field r = f;
  for_each_cell(grid, [&](int i, int j, int k) {
    const double laplacian = (g(i - 1, j, k) + g(i + 1, j, k) + g(i, j - 1, k) + g(i, j + 1, k) +
                              g(i, j, k - 1) + g(i, j, k + 1) - 6 * g(i, j, k)) /
                             (grid.h() * grid.h());
    owned(r)(i, j, k) -= a * g(i, j, k) - b * laplacian;
  });
  return r;
}

// Eigenvalue a + b Σ (2 − 2cos θ_d)/h² of the mode; round-off of a transform pair is a few 1e-16, and the bar
// of the project is 1e-12 relative to the exact solution.
TEST_P(EllipticOn, TrigonometricBackendIsExactOnTrigonometricModes) {
  const Grid grid(Communicator::world(), GetParam().box);
  EllipticSolver solver(grid, EllipticBackend::Trigonometric);
  for (const auto& [a, b] : coefficients(grid.h()))
    for (const Symmetry& symmetry : symmetries(grid.box()))
      for (const Index3& number : {Index3{1, 2, 3}, Index3{4, 1, 2}, Index3{3, 5, 7}}) {
        Field f(grid), x(grid, symmetry), exact(grid, symmetry);
        fill_mode(exact, number);
        double eigenvalue = a;
        for (int axis = 0; axis < 3; ++axis)
          eigenvalue +=
              b * (2 - 2 * std::cos(mode_theta(grid.box(), axis, number[axis]))) / (grid.h() * grid.h());
        for (std::size_t m = 0; m < f.values().size(); ++m) f.values()[m] = eigenvalue * exact.values()[m];
        solver.solve(a, b, f, x);
        EXPECT_LT(largest_difference(x, exact), 1e-12);
      }
}

TEST_P(EllipticOn, TrigonometricSolutionOfARandomRightSideSatisfiesTheSevenPointEquation) {
  const Grid grid(Communicator::world(), GetParam().box);
  EllipticSolver solver(grid, EllipticBackend::Trigonometric);
  for (const auto& [a, b] : coefficients(grid.h()))
    for (const Symmetry& symmetry : symmetries(grid.box())) {
      Field f(grid, symmetry), x(grid, symmetry);
      fill_random(f, 3);
      solver.solve(a, b, f, x);
      if (is_singular(grid.box(), a, symmetry)) {
        const double mean = sum(f) / double(grid.total_size());
        for (double& value : f.values()) value -= mean;
      }
      // The Laplacian of a rounded x: condition number below 1e3, times ulp.
      EXPECT_LT(max_abs(residual(a, b, f, x)), 1e-12);
    }
}

// The acceptance bar of the project for the two backends: 1e-8 relative to the largest value, on random right
// sides, for Poisson and Helmholtz problems on periodic, walled and mixed boxes. The multigrid tolerance is
// its default.
TEST_P(EllipticOn, BackendsAgreeOnRandomRightSides) {
  const Grid grid(Communicator::world(), GetParam().box);
  EllipticSolver trigonometric(grid, EllipticBackend::Trigonometric),
      multigrid(grid, EllipticBackend::Multigrid);
  for (const auto& [a, b] : coefficients(grid.h()))
    for (const Symmetry& symmetry : symmetries(grid.box())) {
      Field f(grid, symmetry), x(grid, symmetry), y(grid, symmetry);
      fill_random(f, 17);
      trigonometric.solve(a, b, f, x);
      multigrid.solve(a, b, f, y);
      EXPECT_GT(max_abs(x), 0);
      EXPECT_LT(largest_difference(x, y), 1e-8 * max_abs(x)) << "a = " << a << ", b = " << b;
    }
}

TEST_P(EllipticOn, SingularProblemsDropTheMeanOfTheRightSideAndGiveMeanZero) {
  const Grid grid(Communicator::world(), GetParam().box);
  for (const auto backend : {EllipticBackend::Trigonometric, EllipticBackend::Multigrid}) {
    EllipticSolver solver(grid, backend);
    Field f(grid), shifted(grid), x(grid), y(grid);
    fill_random(f, 23);
    for (std::size_t m = 0; m < f.values().size(); ++m) shifted.values()[m] = f.values()[m] + 7.0;
    solver.solve(0, 1, f, x);
    solver.solve(0, 1, shifted, y);
    EXPECT_LT(std::abs(sum(x)), 1e-12 * double(grid.total_size()) * max_abs(x));
    // Multigrid stops at a relative residual of 1e-10; see the bar above.
    EXPECT_LT(largest_difference(x, y), 1e-8 * max_abs(x));
  }
}

TEST_P(EllipticOn, RightSideAndSolutionMayBeOneField) {
  const Grid grid(Communicator::world(), GetParam().box);
  for (const auto backend : {EllipticBackend::Trigonometric, EllipticBackend::Multigrid}) {
    EllipticSolver solver(grid, backend);
    const Symmetry symmetry = velocity_symmetry(grid.box(), 0);
    Field f(grid, symmetry), x(grid, symmetry);
    fill_random(f, 29);
    solver.solve(1, grid.h() * grid.h(), f, x);
    solver.solve(1, grid.h() * grid.h(), f, f);
    EXPECT_EQ(largest_difference(f, x), 0);
  }
}

TEST_P(EllipticOn, TrigonometricSolutionIsTheSameToTheLastBitOnAnyNumberOfRanks) {
  const Grid grid(Communicator::world(), GetParam().box);
  const Grid serial(Communicator(MPI_COMM_SELF), GetParam().box);
  EllipticSolver solver(grid, EllipticBackend::Trigonometric),
      serial_solver(serial, EllipticBackend::Trigonometric);
  for (const Symmetry& symmetry : symmetries(grid.box())) {
    Field f(grid), f_serial(serial), x(grid, symmetry), x_serial(serial, symmetry);
    fill_random(f, 31);
    fill_random(f_serial, 31);
    solver.solve(0, 1, f, x);
    serial_solver.solve(0, 1, f_serial, x_serial);
    EXPECT_EQ(gather(x), gather(x_serial));
  }
}

TEST(EllipticMultigrid, AnswersStayRightWhenMoreSystemsAreMetThanKept) {
  const Grid grid(Communicator::world(), make_box({8, 8, 16}, {}));
  EllipticSolver trigonometric(grid, EllipticBackend::Trigonometric),
      multigrid(grid, EllipticBackend::Multigrid);
  Field f(grid), x(grid), y(grid);
  fill_random(f, 37);
  // Eight are kept: the ninth drops the first, which is then met again, and the last is found.
  for (const int m : {1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 9}) {
    const double b = m * grid.h() * grid.h();
    trigonometric.solve(1, b, f, x);
    multigrid.solve(1, b, f, y);
    EXPECT_LT(largest_difference(x, y), 1e-8 * max_abs(x));
  }
}

TEST(EllipticMultigrid, NoConvergenceIsANumericalErrorThatSaysWhatHappened) {
  const Grid grid(Communicator::world(), make_box({16, 16, 16}, {}));
  EllipticSolver solver(grid, EllipticBackend::Multigrid);
  Field f(grid), x(grid);
  fill_random(f, 41);
  for_each_cell(grid, [&](int i, int j, int k) {
    if (i == 2 && j == 3 && k == 0) owned(f)(i, j, k) = std::numeric_limits<double>::infinity();
  });
  try {
    solver.solve(1, grid.h() * grid.h(), f, x);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("iterations"), std::string::npos) << error.what();
  }
}

TEST(EllipticMultigrid, ZeroRightSideGivesZero) {
  const Grid grid(Communicator::world(), make_box({8, 8, 16}, {}));
  EllipticSolver solver(grid, EllipticBackend::Multigrid);
  Field f(grid), x(grid);
  fill_random(x, 43);
  solver.solve(0, 1, f, x);
  EXPECT_EQ(max_abs(x), 0);
}

TEST(Elliptic, NegativeCoefficientsBreakTheContract) {
  const Grid grid(Communicator::world(), make_box({8, 8, 16}, {}));
  EllipticSolver solver(grid, EllipticBackend::Trigonometric);
  Field f(grid), x(grid);
  EXPECT_THROW(solver.solve(-1, 1, f, x), std::logic_error);
  EXPECT_THROW(solver.solve(1, 0, f, x), std::logic_error);
}

}  // namespace
}  // namespace spume::grid
