#include "spume/interface/indicators.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analytic_foams.hpp"
#include "spume/interface/potentials.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::interface {
namespace {

using testing::h;

/// A ball's indicator smoothed by a Gaussian of variance s, at the distance r from its centre.
double gaussian_ball(double radius, double r, double s) {
  const double width = std::sqrt(2 * s);
  const double near = (radius - r) / width, far = (radius + r) / width;
  return 0.5 * (std::erf(near) + std::erf(far)) -
         std::sqrt(s / (2 * std::numbers::pi)) / r * (std::exp(-near * near) - std::exp(-far * far));
}

/// The same for the kernel e^{−z}(1 + z + z²/2): z and z² act as −s ∂/∂s and s² ∂²/∂s² on the Gaussian.
double smoothed_ball(double radius, double r, double s) {
  const double step = 1e-3 * s;
  const double low = gaussian_ball(radius, r, s - step), middle = gaussian_ball(radius, r, s),
               high = gaussian_ball(radius, r, s + step);
  return middle - s * (high - low) / (2 * step) + 0.5 * s * s * (high - 2 * middle + low) / (step * step);
}

/// The indicator of phase 1, and the block that it is on.
PhaseField indicator_of(const grid::Grid& grid, const mesh::FilmMesh& films, double variance) {
  const auto midpoints = edge_midpoints(films, mesh::build_topology(films));
  const PhaseBlocks blocks = blocks_of_phases(grid, films, 2);
  return {1, blocks.cells[1], 0, smoothed_indicators(grid, films, midpoints, blocks, variance)[1],
          lattice_of(grid.box())};
}

/// Largest difference between the smoothed indicator of a triangulated sphere and the exact one of the ball.
double sphere_error(grid::Boundary boundary, int levels, double variance) {
  grid::Box box = testing::cube_box(32);
  box.boundary = {boundary, boundary, boundary};
  const grid::Grid grid(parallel::Communicator::world(), box);
  const Vec3 centre{0.3 * h, -0.2 * h, 0.1 * h};
  const double radius = 8 * h;
  const auto indicator = indicator_of(grid, testing::icosphere(centre, radius, levels), variance);
  double error = 0;
  for_each_cell(indicator.cells, [&](int i, int j, int k) {
    const double exact = smoothed_ball(radius, norm(grid.centre(i, j, k) - centre), variance);
    error = std::max(error, std::abs(indicator.at(i, j, k) - exact));
  });
  return error;
}

TEST(SmoothedIndicator, OfASphereConvergesToTheExactConvolution) {
  for (const auto boundary : {grid::Boundary::Periodic, grid::Boundary::Wall}) {
    const double coarse = sphere_error(boundary, 3, 4 * h * h), fine = sphere_error(boundary, 4, 4 * h * h);
    // Curved triangles with edges of 1.3 h are as good as finer ones already: what is left is aliasing, 1e-4
    // of the kernel at the shortest wave of the grid, and the quadrature's. Flat ones would be wrong by 1e-2.
    EXPECT_LT(coarse, 4e-4);
    EXPECT_LT(fine, 4e-4);
    // At s = 2 h² the kernel is still 3e-3 at the shortest wave of the grid: aliasing of that size joins in.
    EXPECT_LT(sphere_error(boundary, 4, 2 * h * h), 4e-3);
  }
}

TEST(SmoothedIndicator, IsOneInsideHalfOnTheFilmAndZeroOutside) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(40));
  const double radius = 12.5 * h;
  const auto indicator =
      indicator_of(grid, testing::icosphere({0.5 * h, 0.5 * h, 0.5 * h}, radius, 3), 2 * h * h);
  const auto at = [&](int i) { return indicator.at(i, 20, 20); };
  EXPECT_NEAR(at(20), 1, 1e-3);
  EXPECT_NEAR(at(2), 0, 1e-3);
  // 32.5 lies between cells 32 and 33. Curvature moves the level ½ by (2/R) s/10 = 0.032 h. The triangles
  // have edges of 2 h.
  const double exact = 0.5 * (smoothed_ball(radius, radius - 0.5 * h, 2 * h * h) +
                              smoothed_ball(radius, radius + 0.5 * h, 2 * h * h));
  EXPECT_NEAR(0.5 * (at(32) + at(33)), exact, 1e-3);
}

TEST(SmoothedIndicator, HasTheMeanOfTheEnclosedVolume) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(32));
  const double radius = 8 * h;
  const auto indicator = indicator_of(grid, testing::icosphere({}, radius, 4), 2 * h * h);
  double volume = 0;
  for (double c : indicator.value) volume += c * h * h * h;
  // The flat pieces of curved triangles are inscribed by less than 0.003 h: 3 × 0.003/8.
  EXPECT_NEAR(volume / (4 * std::numbers::pi / 3 * radius * radius * radius), 1, 1e-3);
}

/// A ball of each radius, phases 1, 2, …, side by side along x.
mesh::FilmMesh row_of_balls(std::initializer_list<double> places, double radius) {
  mesh::FilmMesh films;
  mesh::Phase phase = 0;
  for (double place : places) {
    ++phase;
    const auto ball = testing::icosphere({place, 0, 0}, radius, 2);
    const int first = films.n_vertices();
    films.position.insert(films.position.end(), ball.position.begin(), ball.position.end());
    for (auto t : ball.triangle) {
      for (int& v : t.vertex) v += first;
      t.phase_b = phase;
      films.triangle.push_back(t);
    }
  }
  return films;
}

TEST(SmoothedIndicator, OfABubbleDoesNotFeelItsNeighboursNorWhereItIsInTheBox) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(48));
  mesh::FilmMesh films = row_of_balls({-20 * h, 0, 9 * h}, 4 * h);
  films.domain = grid.box().domain();  // the first goes over the edge of the box
  const auto midpoints = edge_midpoints(films, mesh::build_topology(films));
  const PhaseBlocks blocks = blocks_of_phases(grid, films, 4);
  const auto indicator = smoothed_indicators(grid, films, midpoints, blocks, 2 * h * h);
  for (mesh::Phase p : {1, 3}) {
    ASSERT_EQ(indicator[p].size(), indicator[2].size());
    double difference = 0;
    for (std::size_t n = 0; n < indicator[p].size(); ++n)
      difference = std::max(difference, std::abs(indicator[p][n] - indicator[2][n]));
    EXPECT_LT(difference, 1e-12);  // shifted by whole cells
  }
}

TEST(PhaseBlocks, ReachEightCellsBeyondTheFilmsOrAllAround) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(48));
  const mesh::FilmMesh films = row_of_balls({0.25 * h, 9.25 * h}, 4 * h);
  const PhaseBlocks blocks = blocks_of_phases(grid, films, 4);
  EXPECT_TRUE(blocks.cells[0].empty());
  EXPECT_TRUE(blocks.cells[3].empty());
  // Films from −3.75 h to 4.25 h, the lower face of cell 24 at 0.
  EXPECT_EQ(blocks.cells[1].begin, (Index3{12, 12, 12}));
  EXPECT_EQ(blocks.cells[1].end.i, 37);
  EXPECT_EQ(blocks.cells[2].begin.i - blocks.cells[1].begin.i, 9);
  EXPECT_EQ(blocks.room[1].end.i - blocks.room[1].begin.i, 30);  // 25 cells, and a size for transforms

  const grid::Grid small(parallel::Communicator::world(), testing::cube_box(24));
  const PhaseBlocks whole = blocks_of_phases(small, films, 4);
  EXPECT_EQ(whole.cells[1].size(), small.total_size());
  EXPECT_EQ(whole.room[1].size(), small.total_size());
}

}  // namespace
}  // namespace spume::interface
