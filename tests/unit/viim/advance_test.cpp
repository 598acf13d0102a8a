#include "spume/viim/advance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "spume/grid/loops.hpp"
#include "straight_films.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::viim {
namespace {

using testing::h;

constexpr double infinite = std::numeric_limits<double>::infinity();

std::vector<ClosestPoint> band_of_cells(const std::vector<std::size_t>& cells) {
  std::vector<ClosestPoint> band(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) band[n].cell = cells[n];
  return band;
}

std::vector<std::size_t> all_cells_of(const DistanceField& field) {
  std::vector<std::size_t> all(field.distance.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Largest error [m] of φ within two cells of the film of a ball that a uniform wind has carried over half
/// its radius.
double error_after_carrying_a_ball(int cells) {
  const auto box = testing::cube_box(12 * h, cells);
  const double radius = 6.3 * h, spacing = box.spacing(), time = 1, courant = 0.4;
  const Vec3 wind = 0.5 * radius * normalized(Vec3{2, -1, 1.5}), start{-1.1 * h, 0.4 * h, -0.9 * h};
  auto field = testing::sampled_ball(box, start, radius, infinite);
  const auto band = band_of_cells(all_cells_of(field));
  const int steps = static_cast<int>(std::ceil(norm(wind) * time / (courant * spacing)));
  for (int n = 0; n < steps; ++n) {
    // χ follows, as it does after each reconstruction.
    const Vec3 centre = start + (n * time / steps) * wind;
    const auto exact = testing::sampled_ball(box, centre, radius, infinite);
    for (std::size_t c = 0; c < field.phase.size(); ++c) {
      if (field.phase[c] == exact.phase[c]) continue;
      field.phase[c] = exact.phase[c];
      field.distance[c] = -field.distance[c];
    }
    advance(field, band, std::vector<Vec3>(band.size(), wind), time / steps);
  }
  const Vec3 centre = start + time * wind;
  double worst = 0;
  for (std::size_t c = 0; c < field.distance.size(); ++c) {
    const double exact = radius - norm(testing::centre_of_cell(box, c) - centre);
    const double found = field.phase[c] == 1 ? field.distance[c] : -field.distance[c];
    if (std::abs(exact) < 2 * spacing) worst = std::max(worst, std::abs(found - exact));
  }
  return worst;
}

// Fifth order in space and third in time where φ is smooth; the step goes with the spacing.
TEST(Advance, CarriesABallToThirdOrderOrBetter) {
  const double coarse = error_after_carrying_a_ball(32), fine = error_after_carrying_a_ball(48);
  const double order = std::log(coarse / fine) / std::log(1.5);
  EXPECT_LT(coarse, 0.001 * h);
  EXPECT_GT(order, 3);
  EXPECT_LT(order, 5.5);
}

// φ of a flat film is linear on both sides: differences are exact unless a stencil sees it turn up again.
TEST(Advance, SeesNoFilmFromEitherSide) {
  const auto box = testing::cube_box(16 * h, 32);
  const testing::StraightFilms film{{0.13 * h, 0.2 * h, 0}, {0.3, 0.3 + std::numbers::pi}};
  auto field = testing::sampled(box, film);
  const auto before = field;
  const Vec3 wind{0.2 * h, 0.9 * h, 0.1 * h};
  const double dt = 0.5;
  const auto band = band_of_cells(all_cells_of(field));
  advance(field, band, std::vector<Vec3>(band.size(), wind), dt);
  const Vec3 normal{-std::sin(0.3), std::cos(0.3), 0};  // out of phase 1
  double worst = 0;
  for (std::size_t c = 0; c < field.distance.size(); ++c) {
    const Vec3 x = testing::centre_of_cell(box, c);
    // Three stages of three cells each bring in the edge of the box.
    if (std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) > 5 * h) continue;
    const double sign = before.phase[c] == 0 ? 1 : -1;
    worst =
        std::max(worst, std::abs(field.distance[c] - (before.distance[c] - sign * dt * dot(wind, normal))));
  }
  EXPECT_LT(worst, 1e-12 * h);
}

TEST(ExtensionVelocity, IsThatOfTheGasAtTheClosestPoint) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(12 * h, 24));
  // A wave of 24 cells: the kernel sees it weaker by 2 % at most.
  const auto velocity_at = [](const Vec3& x) {
    const double k = 2 * std::numbers::pi / (24 * h);
    return Vec3{std::sin(k * x.y), std::cos(k * x.z), std::sin(k * x.x)};
  };
  grid::VectorField velocity(grid);
  for (int axis = 0; axis < 3; ++axis) {
    auto u = grid::owned(velocity[axis]);
    grid::for_each_cell(grid,
                        [&](int i, int j, int k) { u(i, j, k) = velocity_at(grid.centre(i, j, k))[axis]; });
  }
  const auto band = closest_points(shapes::sphere({}, 5 * h, 3, 1), grid.box(), 3 * h);
  ASSERT_GT(band.size(), 1000u);
  const auto u = extension_velocity(band, velocity, {});
  double worst = 0, span = 0;
  for (std::size_t n = 0; n < band.size(); ++n) {
    worst = std::max(worst, norm(u[n] - velocity_at(band[n].point)));
    span = std::max(span, norm(u[n] - velocity_at(band[n].centre)));
  }
  EXPECT_LT(worst, 0.04);
  EXPECT_GT(span, 0.3) << "the velocity at the cell itself is another one";
}

}  // namespace
}  // namespace spume::viim
