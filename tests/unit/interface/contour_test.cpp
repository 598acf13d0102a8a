#include "spume/interface/contour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "analytic_foams.hpp"
#include "spume/base/random.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::interface {
namespace {

using testing::h;

mesh::FilmMesh contour_of(const PhasePotentials& potentials) {
  return contour(parallel::Communicator::self(), potentials, find_winners(potentials));
}

TEST(Contour, OfRandomBubblesIsConforming) {
  for (int n_bubbles : {2, 4, 12}) {
    const grid::Box box = testing::cube_box(40);
    const auto balls = testing::random_balls(n_bubbles, 5 * h, 7 + n_bubbles);
    const auto films = contour_of(testing::sampled(box, testing::power_diagram(balls), n_bubbles + 1));
    const auto topology = mesh::build_topology(films);
    EXPECT_EQ(topology.n_nonconforming_edges, 0) << n_bubbles;
    EXPECT_GE(topology.n_lamellae(), n_bubbles);
    const auto volume = mesh::phase_volumes(films, n_bubbles + 1);
    for (int p = 1; p <= n_bubbles; ++p) EXPECT_GT(volume[p], 0) << "normals point out of phase " << p;
  }
}

// Corners of a face that lie alternately in one phase and the other, as in necks about to open.
TEST(Contour, OfTwoPhasesInThinNecksIsConforming) {
  const grid::Box box = testing::cube_box(24);
  for (int seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    struct Wave {
      Vec3 k;
      double shift;
    };
    std::vector<Wave> waves;
    for (int n = 0; n < 12; ++n) {
      const auto number = [&] { return std::floor(random.uniform(-8, 9)); };  // of periods of the box
      const Vec3 m{number(), number(), number()};
      waves.push_back({2 * M_PI / (24 * h) * m, random.uniform(0, 2 * M_PI)});
    }
    const auto noise = [&](mesh::Phase p, const Vec3& x) {
      double sum = 0;
      for (const Wave& wave : waves) sum += std::cos(dot(wave.k, x) + wave.shift);
      return (p == 1 ? 1 : -1) * h * sum;
    };
    const auto films = contour_of(testing::sampled(box, noise, 2));
    EXPECT_GT(films.n_triangles(), 1000);
    EXPECT_EQ(mesh::build_topology(films).n_nonconforming_edges, 0) << "seed " << seed;
  }
}

TEST(Contour, OfASphereHasItsVolumeAndOneClosedSurface) {
  const grid::Box box = testing::cube_box(24);
  const double radius = 7.3 * h;
  const auto films = contour_of(testing::sampled(box, testing::power_diagram({{{}, radius}}), 2));
  const double volume = mesh::phase_volumes(films, 2)[1];
  // Linear in cells: the radius is short by less than h²/(8R) × 3 (Kuhn diagonals), 0.7 % each.
  EXPECT_NEAR(volume / (4 * M_PI / 3 * radius * radius * radius), 0.99, 0.01);
  EXPECT_EQ(films.n_vertices() - 3 * films.n_triangles() / 2 + films.n_triangles(), 2);  // Euler
}

TEST(Contour, PutsVerticesOnTheTiesOfLinearPotentials) {
  // Three half-planes at 120 degrees meet in the line x = 0.3 h, y = 0.2 h; linear functions are met exactly.
  const grid::Box box = testing::walled(testing::cube_box(16));
  const auto wedges = [](mesh::Phase p, const Vec3& x) {
    const double angle = 2 * M_PI * p / 3 + 0.4;
    return std::cos(angle) * (x.x - 0.3 * h) + std::sin(angle) * (x.y - 0.2 * h);
  };
  const auto films = contour_of(testing::sampled(box, wedges, 3));
  const auto topology = mesh::build_topology(films);
  for (int v = 0; v < films.n_vertices(); ++v) {
    const auto& phases = topology.vertex_phases[v];
    for (int m = 1; m < phases.size(); ++m)
      EXPECT_NEAR(wedges(phases[0], films.position[v]), wedges(phases[m], films.position[v]), 1e-12 * h);
  }
  EXPECT_EQ(topology.n_borders(), 1);
  EXPECT_EQ(topology.n_lamellae(), 3);
}

TEST(Contour, FindsAPhaseThatWinsInsideAnEdgeOnly) {
  // Phase 2 is largest only in a slab thinner than a cell between phases 0 and 1, where no lattice point
  // lies.
  const grid::Box box = testing::walled(testing::cube_box(8));
  const auto slab = [](mesh::Phase p, const Vec3& x) { return p == 0 ? x.x : p == 1 ? -x.x : 0.2 * h; };
  const auto films = contour_of(testing::sampled(box, slab, 3));
  std::set<std::pair<int, int>> pairs;
  for (const auto& t : films.triangle) pairs.insert({t.phase_a, t.phase_b});
  EXPECT_EQ(pairs, (std::set<std::pair<int, int>>{{0, 2}, {1, 2}}));
}

}  // namespace
}  // namespace spume::interface
