#include "spume/viim/distance_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spume/interface/contour.hpp"
#include "spume/interface/find_films.hpp"
#include "straight_films.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::viim {
namespace {

using testing::h;

const Vec3 centre{0.137 * h, 0.371 * h, 0.219 * h};
constexpr double radius = 6.3 * h;

/// Of cells nearer to the film than `within` cells.
double largest_error(const DistanceField& field, double within) {
  double worst = 0;
  for (std::size_t c = 0; c < field.distance.size(); ++c) {
    const double exact = std::abs(norm(testing::centre_of_cell(field.box, c) - centre) - radius);
    if (exact < within * field.box.spacing()) worst = std::max(worst, std::abs(field.distance[c] - exact));
  }
  return worst;
}

/// ψ of a ball that are no distances: their slope varies by a third within five cells at the coarse spacing.
interface::PhasePotentials ball_potentials(const grid::Box& box) {
  interface::PhasePotentials potentials(box);
  for (mesh::Phase p : {0, 1}) {
    interface::PhaseField field {
      p, interface::all_cells(box.cells), 0, {}
    };
    for (std::size_t c = 0; c < field.cells.size(); ++c) {
      const double r = norm(testing::centre_of_cell(box, c) - centre);
      field.value.push_back((p == 1 ? 1 : -1) * (radius * radius - r * r) / (2 * radius));
    }
    potentials.set(std::move(field));
  }
  return potentials;
}

// The tricubic of these ψ is exact and so is Newton's method, unless it starts too far from the closest
// point, as it may near the centre of the ball. What is left is round-off.
TEST(DistanceTo, FilmsOfPolynomialPotentialsIsExact) {
  const auto potentials = ball_potentials(testing::cube_box(13 * h, 26));
  state::Phases phases;
  phases.target_volume = {0, 1};
  auto films =
      interface::contour(parallel::Communicator::self(), potentials, interface::find_winners(potentials));
  const auto field = distance_to(films, mesh::build_topology(films), potentials);
  EXPECT_LT(largest_error(field, 3), 1e-8 * h);
  EXPECT_EQ(field.phase, interface::find_winners(potentials));
}

// Films that are their own distance: ½(ψ_1 − ψ_0) = R − r, whose tricubic is of fourth order.
TEST(DistanceTo, IsOfFourthOrderForABall) {
  std::vector<double> error;
  for (int cells : {26, 52}) {
    const auto box = testing::cube_box(13 * h, cells);
    auto potentials = ball_potentials(box);
    for (mesh::Phase p : {0, 1}) {
      auto& field = *potentials.find(p);
      for (std::size_t c = 0; c < field.value.size(); ++c)
        field.value[c] = (p == 1 ? 1 : -1) * (radius - norm(testing::centre_of_cell(box, c) - centre));
    }
    const auto films =
        interface::contour(parallel::Communicator::self(), potentials, interface::find_winners(potentials));
    error.push_back(largest_error(distance_to(films, mesh::build_topology(films), potentials), 3));
  }
  const double order = std::log2(error[0] / error[1]);
  EXPECT_GT(order, 3.3);
  EXPECT_LT(order, 5);
}

// Flat triangles with vertices on the sphere are off by ℓ²/(8R) at most, 0.03 h here; divided along their
// curved sides a quarter is left.
TEST(DistanceTo, AMeshTakesItsTrianglesAsCurved) {
  const auto box = testing::cube_box(13 * h, 26);
  const auto films = shapes::sphere(centre, radius, 3, 1);
  const auto chi = testing::sampled_ball(box, centre, radius, band_cells * h).phase;
  const auto field = distance_to(films, mesh::build_topology(films), box, chi);
  EXPECT_LT(largest_error(field, 3), 0.012 * h);
  EXPECT_EQ(field.phase, chi);
}

TEST(SignedDistance, TurnsItsSignBehindTheFilmsOfItsPhase) {
  const auto box = testing::cube_box(10 * h, 20);
  const auto field = testing::sampled_ball(box, centre, radius, band_cells * h);
  const interface::CellBox cells {
    {3, 4, 5}, { 17, 16, 15 }
  };
  const auto s = signed_distance(field, 1, cells);
  ASSERT_EQ(s.size(), cells.size());
  std::size_t n = 0;
  interface::for_each_cell(cells, [&](int i, int j, int k) {
    const Vec3 x = box.lower + h * Vec3{i + 0.5, j + 0.5, k + 0.5};
    EXPECT_NEAR(s[n++], std::max(radius - norm(x - centre), -band_cells * h), 1e-12 * h);
  });
}

}  // namespace
}  // namespace spume::viim
