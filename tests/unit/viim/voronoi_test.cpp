#include "spume/viim/voronoi.hpp"

#include <gtest/gtest.h>

#include "straight_films.hpp"

namespace spume::viim {
namespace {

using testing::h;

constexpr double degrees = std::numbers::pi / 180;

Vec3 border_of(const interface::PhasePotentials& potentials, const Vec3& near) {
  const auto border = potentials.project(near, {0, 1, 2});
  EXPECT_TRUE(border.has_value());
  return border.value_or(near);
}

TEST(Voronoi, LeavesThreeStraightFilmsAt120DegreesWhereTheyAre) {
  double worst = 0, sum = 0;
  int n = 0;
  for (double turn : {0.0, 11.0, 23.0, 37.0, 49.0})
  for (const Vec3& offset : {Vec3{0.137, 0.371, 0}, {0.5,0.,0}, {-.22,-.4,0}}) {
  const testing::StraightFilms films{offset * h, {(10 +turn)* degrees, (130 +turn)* degrees, (250+turn) * degrees}};
  const auto potentials = voronoi_potentials(sampled(testing::cube_box(24), films), 1.5 * h);
  const Vec3 shift = border_of(potentials, films.junction) - films.junction;
  worst=std::max(worst,norm(shift)/h); sum+=norm(shift)/h; ++n;
  }
  printf("worst %g mean %g\n", worst, sum/n);
}

TEST(Voronoi, PullsAJunctionInAStraightFilmAQuarterOfEpsilonTowards120Degrees) {
 for (double turn : {0., 13.,33.,57.})
  for (double e : {1.,1.5, 2.,3.}) {
  const testing::StraightFilms films{{0.137 * h, 0.371 * h, 0}, {turn*degrees, (180+turn)* degrees, (270+turn) * degrees}};
  const auto potentials = voronoi_potentials(sampled(testing::cube_box(32), films), e * h);
  const Vec3 d{std::sin(turn*degrees),-std::cos(turn*degrees),0};
  const Vec3 shift = border_of(potentials, films.junction) - films.junction;
  printf("%g eps %g : %g  off %g\n", turn, e, dot(shift,d)/(e*h)*4, norm(shift-dot(shift,d)*d)/h);
  }
}

}  // namespace
}  // namespace spume::viim
