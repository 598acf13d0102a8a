#include "spume/viim/voronoi.hpp"

#include <gtest/gtest.h>

#include "straight_films.hpp"

namespace spume::viim {
namespace {

using testing::degrees;
using testing::h;

/// Where three phases of straight films meet after the reconstruction, found from `start`.
Vec3 border_of(const testing::StraightFilms& films, double half_width, int cells, double epsilon,
               const Vec3& start) {
  const auto potentials =
      voronoi_potentials(sampled(testing::walled(testing::cube_box(half_width, cells)), films), epsilon);
  const auto border = potentials.project(start, {0, 1, 2});
  EXPECT_TRUE(border.has_value());
  return border.value_or(start);
}

// Three films at 120 degrees are their own Voronoi interface. The distance creases on bisectors, where its
// interpolation is first order: the border is found to 0.10 h at worst and 0.06 h in the mean (measured).
TEST(Voronoi, LeavesThreeStraightFilmsAt120DegreesWhereTheyAre) {
  double sum = 0;
  int n = 0;
  for (double turn : {10.0, 33.0, 59.0})
    for (const Vec3& place : {Vec3{0.137, 0.371, 0}, Vec3{0.5, 0, 0}, Vec3{-0.22, -0.4, 0}}) {
      const testing::StraightFilms films{h * place,
                                         {turn * degrees, (120 + turn) * degrees, (240 + turn) * degrees}};
      const Vec3 border = border_of(films, 12 * h, 24, 1.5 * h, films.junction);
      const double shift = norm(border - films.junction) / h;
      EXPECT_LT(shift, 0.15) << "turned by " << turn;
      sum += shift;
      ++n;
    }
  EXPECT_LT(sum / n, 0.08);
}

// The two corners of 90 degrees have their cores' corners at ε from both films, the straight side has its
// core in a plane: the three are equally far from the point ε/4 below the junction.
TEST(Voronoi, PullsAJunctionInAStraightFilmAQuarterOfEpsilonTowards120Degrees) {
  const double epsilon = 6e-4;
  for (double turn : {13.0, 57.0}) {
    const testing::StraightFilms films{{0.137 * h, 0.371 * h, 0},
                                       {turn * degrees, (180 + turn) * degrees, (270 + turn) * degrees}};
    const Vec3 down{std::sin(turn * degrees), -std::cos(turn * degrees), 0};
    const Vec3 expected = films.junction + 0.25 * epsilon * down;
    std::vector<double> error;
    for (int refinement : {1, 2, 4}) {
      const Vec3 border = border_of(films, 16 * h, 16 * refinement, epsilon, expected);
      error.push_back(norm(border - expected) / epsilon);
    }
    // First order in h/ε, because of the creases (single values scatter around it).
    EXPECT_LT(error[0], 0.08);
    EXPECT_LT(error[2], 0.02);
    EXPECT_LT(error[2], 0.45 * error[0]);
  }
}

// Distances of a smooth film are those of its core plus ε, up to the tricubic's error.
TEST(Voronoi, ReproducesABallToFourthOrder) {
  std::vector<double> error;
  for (int cells : {24, 48}) {
    const auto box = testing::walled(testing::cube_box(12 * h, cells));
    const Vec3 centre{0.137 * h, 0.371 * h, 0.219 * h};
    const double radius = 6.3 * h, epsilon = 1.5 * box.spacing();
    const auto potentials =
        voronoi_potentials(testing::sampled_ball(box, centre, radius, band_cells * box.spacing()), epsilon);
    double worst = 0;
    Vec3 gradient;
    for (int n = 0; n < 200; ++n) {
      const double z = -1 + (2 * n + 1) / 200.0, a = 2.4 * n, r = std::sqrt(1 - z * z);
      const Vec3 x = centre + radius * Vec3{r * std::cos(a), r * std::sin(a), z};
      worst = std::max(
          worst, std::abs(potentials.difference(*potentials.find(1), *potentials.find(0), x, gradient)));
    }
    error.push_back(worst / radius);
  }
  const double order = std::log2(error[0] / error[1]);
  EXPECT_LT(error[0], 2e-4);
  EXPECT_GT(order, 3.3);
  EXPECT_LT(order, 5);
}

TEST(Voronoi, KnowsPhasesThatHaveNoCore) {
  const auto box = testing::walled(testing::cube_box(12 * h, 24));
  state::Phases phases;
  phases.target_volume = {0, 1e-12, 0};
  EXPECT_TRUE(
      phases_without_core(testing::sampled_ball(box, {}, 3 * h, band_cells * h), phases, 1.5 * h).empty());
  EXPECT_EQ(phases_without_core(testing::sampled_ball(box, {}, 1.6 * h, band_cells * h), phases, 1.5 * h),
            std::vector<mesh::Phase>{1});
}

}  // namespace
}  // namespace spume::viim
