#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spume/transport/transfer.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/unit/transport/film_patterns.hpp"

namespace spume {
namespace {

using patterns::Foam;

constexpr double radius = 1e-3;     // [m]
constexpr double eta0 = 1e-6;       // [m]
constexpr double lambda0 = 1e-9;    // [m²]
constexpr double h = 0.4 * radius;  // on which the flat lamellae of four bubbles are smaller than 10 h²

double uniform_eta(const Vec3&) {
  return eta0;
}
double uniform_lambda(const Vec3&) {
  return lambda0;
}

/// Four bubbles with uniform liquid, and the η of one flat lamella multiplied.
struct OneOddLamella {
  Foam foam{shapes::four_bubbles(radius, 6)};
  int odd = patterns::lamella_between(foam, 1, 2);
  state::FilmLiquid liquid = patterns::liquid_of(foam, uniform_eta, uniform_lambda);

  explicit OneOddLamella(double factor) {
    for (std::size_t d = 0; d < liquid.lamella_volume.size(); ++d)
      if (foam.topology.film_dof[d].lamella == odd) liquid.lamella_volume[d] *= factor;
  }
  double area() const { return mesh::lamella_areas(foam.films, foam.topology)[odd]; }
};

TEST(SmallLamella, MuchThickerThanItsNeighboursGivesTheExcessToItsBorders) {
  OneOddLamella start(10);
  ASSERT_LT(start.area(), 10 * h * h);
  const Foam& foam = start.foam;
  transport::TransferReport report;
  const state::FilmLiquid after =
      transport::transfer(parallel::Communicator::self(), foam.films, foam.topology, start.liquid, foam.films,
                          foam.topology, h, {}, report);
  EXPECT_LE(std::abs(after.total() / start.liquid.total() - 1), 1e-14);
  // The others are uniform, so the cap is 2 η0 exactly.
  EXPECT_NEAR(patterns::held_by(foam, after, start.odd), 2 * (2 * eta0) * start.area(),
              1e-9 * eta0 * start.area());
  EXPECT_NEAR(report.capped, 8 * (2 * eta0) * start.area(), 1e-9 * report.capped);
  const std::vector<double> length = mesh::border_dof_lengths(foam.films, foam.topology);
  for (std::size_t d = 0; d < length.size(); ++d) {
    const auto& phases = foam.topology.border[foam.topology.border_dof[d].border].phases;
    const bool on_rim =
        std::count(phases.begin(), phases.end(), 1) && std::count(phases.begin(), phases.end(), 2);
    const double lambda = after.border_volume[d] / length[d];
    if (on_rim)
      EXPECT_GT(lambda, 1.5 * lambda0);
    else
      EXPECT_NEAR(lambda, lambda0, 1e-9 * lambda0);
  }
}

TEST(LargeLamella, KeepsItsLiquidHoweverThick) {
  OneOddLamella start(10);
  const Foam& foam = start.foam;
  transport::TransferReport report;
  const state::FilmLiquid after =
      transport::transfer(parallel::Communicator::self(), foam.films, foam.topology, start.liquid, foam.films,
                          foam.topology, 0.1 * radius, {}, report);
  EXPECT_EQ(report.capped, 0);
  EXPECT_NEAR(patterns::held_by(foam, after, start.odd), patterns::held_by(foam, start.liquid, start.odd),
              1e-12 * start.liquid.total());
}

TEST(YoungLamella, IsFilledToTheFloorFromItsBorders) {
  OneOddLamella start(0.01);
  const Foam& foam = start.foam;
  start.liquid.lamella_is_young[start.odd] = 1;
  for (double& volume : start.liquid.border_volume) volume *= 1000;
  const state::FilmLiquid before = start.liquid;
  const double moved = transport::fill_young_films(foam.films, foam.topology, start.liquid, h, {});
  EXPECT_LE(std::abs(start.liquid.total() / before.total() - 1), 1e-14);
  EXPECT_NEAR(moved, before.in_borders() - start.liquid.in_borders(), 1e-9 * moved);
  const std::vector<double> eta = patterns::half_thickness(foam, start.liquid);
  for (std::size_t d = 0; d < eta.size(); ++d)
    EXPECT_NEAR(eta[d], foam.topology.film_dof[d].lamella == start.odd ? 0.5 * eta0 : eta0, 1e-9 * eta0);
}

TEST(YoungLamella, IsFilledFromFilmsAroundWhereBordersHaveNothingToSpare) {
  OneOddLamella start(0.01);
  const Foam& foam = start.foam;
  start.liquid.lamella_is_young[start.odd] = 1;
  for (double& volume : start.liquid.border_volume) volume = 0;
  const state::FilmLiquid before = start.liquid;
  const double moved = transport::fill_young_films(foam.films, foam.topology, start.liquid, h, {});
  EXPECT_GT(moved, 0);
  EXPECT_LE(std::abs(start.liquid.total() / before.total() - 1), 1e-14);
  const std::vector<double> eta = patterns::half_thickness(foam, start.liquid);
  for (std::size_t d = 0; d < eta.size(); ++d) {
    EXPECT_GE(eta[d], (1 - 1e-9) * 0.5 * eta0);  // donors give half at most
    EXPECT_LE(eta[d], (1 + 1e-9) * eta0);
  }
}

TEST(YoungLamella, TakesNoBorderBelowHalfTheMean) {
  OneOddLamella start(0.01);
  const Foam& foam = start.foam;
  start.liquid.lamella_is_young[start.odd] = 1;
  // So little in borders that all they may give is not enough.
  for (double& volume : start.liquid.border_volume) volume *= 1e-3;
  for (int step = 0; step < 20; ++step) {
    // Each step the film has grown and lost: what a T1 does to it.
    for (std::size_t d = 0; d < start.liquid.lamella_volume.size(); ++d)
      if (foam.topology.film_dof[d].lamella == start.odd) start.liquid.lamella_volume[d] *= 0.9;
    const std::vector<double> length = mesh::border_dof_lengths(foam.films, foam.topology);
    const double total_length = std::accumulate(length.begin(), length.end(), 0.0);
    const double mean = start.liquid.in_borders() / total_length;
    const std::vector<double> before = start.liquid.border_volume;
    transport::fill_young_films(foam.films, foam.topology, start.liquid, h, {});
    for (std::size_t d = 0; d < length.size(); ++d)
      EXPECT_GE(start.liquid.border_volume[d], (1 - 1e-9) * std::min(before[d], 0.5 * mean * length[d]));
  }
}

TEST(GrowingBorder, BesideAYoungLamellaIsFilledFromOtherBorders) {
  OneOddLamella start(1);
  const Foam& foam = start.foam;
  // Seen on a finer scale, so that borders longer than √10 h do not count as short.
  const double fine = 0.3 * radius;
  start.liquid.lamella_is_young[start.odd] = 1;
  const auto touches = [&](int border) {
    const auto& phases = foam.topology.border[border].phases;
    return std::count(phases.begin(), phases.end(), 1) && std::count(phases.begin(), phases.end(), 2);
  };
  for (std::size_t d = 0; d < start.liquid.border_volume.size(); ++d)
    if (touches(foam.topology.border_dof[d].border)) start.liquid.border_volume[d] = 0;
  const state::FilmLiquid before = start.liquid;
  EXPECT_GT(transport::fill_young_films(foam.films, foam.topology, start.liquid, fine, {}), 0);
  EXPECT_LE(std::abs(start.liquid.total() / before.total() - 1), 1e-14);
  const std::vector<double> length = mesh::border_dof_lengths(foam.films, foam.topology);
  for (std::size_t d = 0; d < length.size(); ++d) {
    const double lambda = start.liquid.border_volume[d] / length[d];
    // Three borders are filled one after another, each from what its donors have above half their mean at
    // that time.
    EXPECT_GT(lambda, (touches(foam.topology.border_dof[d].border) ? 0.3 : 0.4) * lambda0);
  }
}

TEST(FillYoungFilms, WithoutYoungLamellaeDoesNothing) {
  OneOddLamella start(0.01);
  const state::FilmLiquid before = start.liquid;
  EXPECT_EQ(transport::fill_young_films(start.foam.films, start.foam.topology, start.liquid, h, {}), 0);
  EXPECT_EQ(start.liquid.lamella_volume, before.lamella_volume);
}

TEST(YoungFlag, LastsWhileTheLamellaIsSmallOrGrows) {
  const Foam small(shapes::sphere({}, radius, 2, 1)), grown(shapes::sphere({}, 1.05 * radius, 2, 1));
  state::FilmLiquid liquid = patterns::liquid_of(small, uniform_eta, uniform_lambda);
  const auto young_after = [&](const Foam& from, const Foam& to, bool young_before, double scale) {
    liquid.lamella_is_young[0] = young_before;
    transport::TransferReport report;
    return transport::transfer(parallel::Communicator::self(), from.films, from.topology, liquid, to.films,
                               to.topology, scale, {}, report)
               .lamella_is_young[0] != 0;
  };
  EXPECT_TRUE(young_after(small, grown, true, 0.2 * radius));    // area grown by 10 %
  EXPECT_FALSE(young_after(small, small, true, 0.2 * radius));   // no more
  EXPECT_FALSE(young_after(small, grown, false, 0.2 * radius));  // never was
  EXPECT_TRUE(young_after(small, small, false, 1.2 * radius));   // 4π R² < 10 h²
}

}  // namespace
}  // namespace spume
