#include "spume/rupture/rupture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "spume/mesh/measure.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume {
namespace {

using rupture::Fate;

constexpr double radius = 1e-3;   // [m]
constexpr double eta0 = 1e-6;     // [m]
constexpr double lambda0 = 1e-9;  // [m²]
constexpr double r0 = 0.15 * radius;

/// A foam whose η differs between lamellae (η0 (1 + a + 2 b) for phases a, b) and whose borders hold λ0.
struct Foam {
  mesh::FilmMesh films;
  mesh::Topology topology;
  state::FilmLiquid liquid;
  state::Phases phases;

  Foam(mesh::FilmMesh mesh, int n_bubbles) : films(std::move(mesh)), topology(mesh::build_topology(films)) {
    liquid.lamella_volume = mesh::film_dof_areas(films, topology);
    for (std::size_t d = 0; d < liquid.lamella_volume.size(); ++d) {
      const auto& lamella = topology.lamella[topology.film_dof[d].lamella];
      liquid.lamella_volume[d] *= 2 * eta0 * (1 + lamella.phase_a + 2 * lamella.phase_b);
    }
    liquid.border_volume = mesh::border_dof_lengths(films, topology);
    for (double& volume : liquid.border_volume) volume *= lambda0;
    liquid.lamella_area_at_transfer = mesh::lamella_areas(films, topology);
    liquid.lamella_is_young.assign(topology.lamella.size(), 0);
    phases.target_volume = mesh::phase_volumes(films, n_bubbles + 1);
  }

  rupture::RuptureReport tear(mesh::Phase a, mesh::Phase b, Fate fate = Fate::Redistribute) {
    const auto report = rupture::rupture(a, b, films, liquid, phases, fate, r0);
    topology = mesh::build_topology(films);
    EXPECT_EQ(liquid.lamella_volume.size(), topology.film_dof.size());
    EXPECT_EQ(liquid.border_volume.size(), topology.border_dof.size());
    EXPECT_EQ(liquid.lamella_is_young.size(), topology.lamella.size());
    EXPECT_EQ(liquid.lamella_area_at_transfer.size(), topology.lamella.size());
    return report;
  }
  double held_between(mesh::Phase a, mesh::Phase b) const {
    double sum = 0;
    for (std::size_t d = 0; d < liquid.lamella_volume.size(); ++d) {
      const auto& lamella = topology.lamella[topology.film_dof[d].lamella];
      if (lamella.phase_a == a && lamella.phase_b == b) sum += liquid.lamella_volume[d];
    }
    return sum;
  }
  double everything() const { return liquid.total() + liquid.sprayed; }
};

double relative_change(double before, double after) {
  return std::abs(after / before - 1);
}

TEST(Rupture, OfTheSeptumOfADoubleBubbleLeavesOneBubbleWithARidge) {
  Foam foam(shapes::double_bubble(radius, 12), 2);
  const double before = foam.liquid.total(), septum = foam.held_between(1, 2),
               ring = foam.liquid.in_borders();
  const double volume = foam.phases.target_volume[1] + foam.phases.target_volume[2];
  const rupture::RuptureReport report = foam.tear(2, 1);
  EXPECT_EQ(report.kept, 1);
  EXPECT_EQ(report.gone, 2);
  EXPECT_EQ(report.n_lamellae, 1);
  EXPECT_LT(relative_change(0.75 * std::numbers::pi * radius * radius, report.area), 0.01);
  EXPECT_LT(relative_change(septum, report.liquid), 1e-12);
  EXPECT_LT(relative_change(septum, report.to_borders), 1e-12);
  EXPECT_LT(relative_change(septum + ring, report.to_films), 1e-12);
  EXPECT_EQ(report.sprayed, 0);

  EXPECT_EQ(foam.topology.n_lamellae(), 1);
  EXPECT_EQ(foam.topology.n_borders(), 0);
  EXPECT_EQ(foam.topology.n_nonconforming_edges, 0);
  EXPECT_EQ(shapes::euler_characteristic(foam.films, 1), 2);
  EXPECT_EQ(foam.phases.n_bubbles(), 1);
  EXPECT_LT(relative_change(volume, foam.phases.target_volume[1]), 1e-14);
  EXPECT_LE(relative_change(before, foam.liquid.total()), 1e-14);

  // The ridge lies within r0 of the ring (its edges' midpoints, exactly): farther out the caps are as they
  // were.
  const std::vector<double> dof_area = mesh::film_dof_areas(foam.films, foam.topology);
  double least_on_ring = 1e9;
  for (std::size_t d = 0; d < dof_area.size(); ++d) {
    const Vec3& x = foam.films.position[foam.topology.film_dof[d].vertex];
    const double eta = foam.liquid.lamella_volume[d] / (2 * dof_area[d]);
    const double from_ring = std::hypot(x.x, std::hypot(x.y, x.z) - 0.5 * std::sqrt(3.0) * radius);
    if (from_ring < 1e-6 * radius) least_on_ring = std::min(least_on_ring, eta / eta0);
    if (from_ring > 1.01 * r0) {
      EXPECT_NEAR(eta, (x.x < 0 ? 3 : 5) * eta0, 1e-9 * eta0);
    }
  }
  // What the ring got makes a strip of width 2 r0 of half-thickness (septum + ring)/(2 · 2 r0 · 2π · 0.87 R)
  // ≈ 9 η0 in the mean, and the weights are largest in its middle.
  EXPECT_GT(least_on_ring, 10);
}

TEST(Rupture, AddsUpTheFilmsThatMetAtTheFormerBorder) {
  Foam foam(shapes::double_bubble(radius, 6), 2);
  for (double& volume : foam.liquid.border_volume) volume = 0;
  for (std::size_t d = 0; d < foam.liquid.lamella_volume.size(); ++d)
    if (foam.topology.lamella[foam.topology.film_dof[d].lamella].phase_a == 1)
      foam.liquid.lamella_volume[d] = 0;
  const double before = foam.liquid.total();
  std::vector<double> at_vertex(foam.films.n_vertices(), 0);
  for (std::size_t d = 0; d < foam.liquid.lamella_volume.size(); ++d)
    at_vertex[foam.topology.film_dof[d].vertex] += foam.liquid.lamella_volume[d];
  const std::vector<Vec3> old_position = foam.films.position;
  foam.tear(1, 2);
  EXPECT_LE(relative_change(before, foam.liquid.total()), 1e-14);
  // Nothing was torn that held liquid, so each vertex has what its films had.
  for (std::size_t d = 0; d < foam.liquid.lamella_volume.size(); ++d) {
    const Vec3& x = foam.films.position[foam.topology.film_dof[d].vertex];
    const auto old = std::find(old_position.begin(), old_position.end(), x) - old_position.begin();
    EXPECT_NEAR(foam.liquid.lamella_volume[d], at_vertex[old], 1e-14 * before);
  }
}

TEST(Rupture, WithSprayBooksTheTornFilmAndInjectsTheBordersOwnLiquid) {
  Foam foam(shapes::double_bubble(radius, 6), 2);
  foam.liquid.sprayed = 1e-12;
  const double before = foam.everything(), septum = foam.held_between(1, 2), ring = foam.liquid.in_borders();
  const rupture::RuptureReport report = foam.tear(1, 2, Fate::Spray);
  EXPECT_LT(relative_change(septum, report.sprayed), 1e-12);
  EXPECT_LT(relative_change(septum + 1e-12, foam.liquid.sprayed), 1e-12);
  EXPECT_EQ(report.to_borders, 0);
  EXPECT_LT(relative_change(ring, report.to_films), 1e-12);
  EXPECT_LE(relative_change(before, foam.everything()), 1e-14);
}

TEST(Rupture, OfAnOuterFilmOpensTheBubbleToTheOutside) {
  Foam foam(shapes::double_bubble(radius, 6), 2);
  const double before = foam.liquid.total(), volume = foam.phases.target_volume[1];
  const rupture::RuptureReport report = foam.tear(0, 2);
  EXPECT_EQ(report.kept, 0);
  EXPECT_EQ(report.gone, 2);
  EXPECT_EQ(foam.phases.n_bubbles(), 1);
  EXPECT_FALSE(foam.phases.alive(2));
  EXPECT_EQ(foam.phases.target_volume[1], volume);
  ASSERT_EQ(foam.topology.n_lamellae(), 1);  // the cap of bubble 1 and the septum
  EXPECT_EQ(foam.topology.lamella[0].phase_a, 0);
  EXPECT_EQ(foam.topology.lamella[0].phase_b, 1);
  EXPECT_EQ(foam.topology.n_nonconforming_edges, 0);
  // The former septum's normals were turned: bubble 1 is closed.
  EXPECT_LT(relative_change(volume, mesh::phase_volumes(foam.films, 3)[1]), 1e-12);
  EXPECT_LE(relative_change(before, foam.liquid.total()), 1e-14);
}

TEST(Rupture, OfABubbleIntoThePartAboveAMembraneMakesItThatPart) {
  // Of the double bubble, 2 plays the part above.
  Foam foam(shapes::double_bubble(radius, 6), 2);
  foam.phases.above_membrane = 2;
  EXPECT_EQ(foam.phases.n_bubbles(), 1);
  const double before = foam.liquid.total(), volume = foam.phases.target_volume[1];
  const rupture::RuptureReport report = foam.tear(1, 2);
  EXPECT_EQ(report.kept, 2);
  EXPECT_EQ(report.gone, 1);
  EXPECT_EQ(foam.phases.n_bubbles(), 0);
  EXPECT_EQ(foam.phases.above_membrane, 2);
  EXPECT_LT(relative_change(2 * volume, foam.phases.target_volume[2]), 1e-12);
  EXPECT_LT(relative_change(2 * volume, mesh::phase_volumes(foam.films, 3)[2]), 1e-12);
  EXPECT_LE(relative_change(before, foam.liquid.total()), 1e-14);
  foam.tear(0, 2);
  EXPECT_EQ(foam.phases.above_membrane, 0) << "the outside is one again";
}

TEST(Rupture, OfTheLastBubbleLeavesNothingAndBooksItsLiquid) {
  Foam foam(shapes::sphere({}, radius, 2, 1), 1);
  const double before = foam.liquid.total();
  const rupture::RuptureReport report = foam.tear(0, 1);
  EXPECT_EQ(foam.films.n_triangles(), 0);
  EXPECT_EQ(foam.films.n_vertices(), 0);
  EXPECT_EQ(foam.phases.n_bubbles(), 0);
  EXPECT_LT(relative_change(before, report.sprayed), 1e-12);
  EXPECT_LE(relative_change(before, foam.liquid.sprayed), 1e-14);
  EXPECT_EQ(foam.liquid.total(), 0);
}

TEST(Rupture, OfAFilmWithoutBorderGivesItsLiquidToTheNearestOtherFilm) {
  mesh::FilmMesh films = shapes::sphere({}, radius, 2, 1);
  const mesh::FilmMesh other = shapes::sphere({2.5 * radius, 0, 0}, radius, 2, 2);
  const int n = films.n_vertices();
  films.position.insert(films.position.end(), other.position.begin(), other.position.end());
  for (const auto& t : other.triangle)
    films.triangle.push_back({{t.vertex[0] + n, t.vertex[1] + n, t.vertex[2] + n}, t.phase_a, t.phase_b});
  Foam foam(std::move(films), 2);
  const double before = foam.liquid.total();
  const rupture::RuptureReport report = foam.tear(0, 1);
  EXPECT_EQ(report.sprayed, 0);
  EXPECT_EQ(report.to_borders, 0);
  EXPECT_LT(relative_change(report.liquid, report.to_films), 1e-12);
  EXPECT_LE(relative_change(before, foam.liquid.total()), 1e-14);
  EXPECT_EQ(foam.phases.n_bubbles(), 1);
}

TEST(Rupture, OfAnInnerFilmOfFourBubblesJoinsLamellaeAndBorders) {
  Foam foam(shapes::four_bubbles(radius, 8), 4);
  const double before = foam.liquid.total(), in_borders = foam.liquid.in_borders();
  const double torn = foam.held_between(1, 2);
  const double joined = foam.held_between(1, 3) + foam.held_between(2, 3);
  const double length =
      std::accumulate(foam.liquid.border_volume.begin(), foam.liquid.border_volume.end(), 0.0) / lambda0;
  // Lengths of the borders around the torn film: the one outside, and those of the bubbles 3 and 4.
  const std::vector<double> lengths = mesh::border_lengths(foam.films, foam.topology);
  double rim = 0, rim_3 = 0;
  for (int b = 0; b < foam.topology.n_borders(); ++b) {
    const auto& p = foam.topology.border[b].phases;
    if (!std::count(p.begin(), p.end(), 1) || !std::count(p.begin(), p.end(), 2)) continue;
    rim += lengths[b];
    if (std::count(p.begin(), p.end(), 3)) rim_3 += lengths[b];
  }
  ASSERT_GT(rim_3, 0);
  const rupture::RuptureReport report = foam.tear(1, 2);
  EXPECT_EQ(foam.topology.n_lamellae(), 6);
  EXPECT_EQ(foam.topology.n_borders(), 4);
  EXPECT_EQ(foam.topology.n_junctions(), 2);
  EXPECT_EQ(foam.topology.n_nonconforming_edges, 0);
  EXPECT_LE(relative_change(before, foam.liquid.total()), 1e-14);
  EXPECT_LT(relative_change(torn, report.to_borders), 1e-12);
  // The borders that are left keep λ0 along all their length, also where two became one.
  EXPECT_LT(relative_change(in_borders - lambda0 * rim, foam.liquid.in_borders()), 1e-12);
  EXPECT_GT(length, rim);
  const std::vector<double> dof_length = mesh::border_dof_lengths(foam.films, foam.topology);
  for (std::size_t d = 0; d < dof_length.size(); ++d)
    EXPECT_NEAR(foam.liquid.border_volume[d] / dof_length[d], lambda0, 1e-9 * lambda0);
  // The films towards bubble 3 got the liquid of their ridge: its own and its share, by length, of the torn
  // film's.
  EXPECT_NEAR(foam.held_between(1, 3), joined + lambda0 * rim_3 + torn * rim_3 / rim, 1e-12 * before);
}

TEST(Rupture, PassesOnYouthAndAreaOfTheLargestOfTheLamellaeThatJoin) {
  Foam foam(shapes::double_bubble(radius, 4), 2);
  const double outer = std::accumulate(foam.liquid.lamella_area_at_transfer.begin(),
                                       foam.liquid.lamella_area_at_transfer.end(), 0.0);
  double septum = 0;
  for (int l = 0; l < foam.topology.n_lamellae(); ++l) {
    if (foam.topology.lamella[l].phase_a == 1) septum = foam.liquid.lamella_area_at_transfer[l];
    if (foam.topology.lamella[l].phase_b == 2 && foam.topology.lamella[l].phase_a == 0) {
      foam.liquid.lamella_is_young[l] = 1;
      foam.liquid.lamella_area_at_transfer[l] *= 1.1;
    }
  }
  const double grown = std::accumulate(foam.liquid.lamella_area_at_transfer.begin(),
                                       foam.liquid.lamella_area_at_transfer.end(), 0.0);
  foam.tear(1, 2);
  EXPECT_TRUE(foam.liquid.lamella_is_young[0]);
  EXPECT_GT(grown, outer);
  EXPECT_LT(relative_change(grown - septum, foam.liquid.lamella_area_at_transfer[0]), 1e-12);
}

TEST(Rupture, OneAfterTheOtherUntilNothingIsLeftLosesNothing) {
  for (Fate fate : {Fate::Redistribute, Fate::Spray}) {
    Foam foam(shapes::four_bubbles(radius, 5), 4);
    const double before = foam.everything();
    for (const auto& [a, b] : {std::pair{1, 2}, {3, 4}, {3, 1}, {1, 0}}) {
      foam.tear(a, b, fate);
      EXPECT_LE(relative_change(before, foam.everything()), 1e-14);
      EXPECT_EQ(foam.topology.n_nonconforming_edges, 0);
      if (foam.films.n_triangles() > 0) {
        EXPECT_GE(*std::min_element(foam.liquid.lamella_volume.begin(), foam.liquid.lamella_volume.end()), 0);
      }
    }
    EXPECT_EQ(foam.films.n_triangles(), 0);
    EXPECT_EQ(foam.phases.n_bubbles(), 0);
  }
}

// Three triangles on the same three vertices: two flat bubbles back to back. Torn apart, what is left is
// folded onto itself until the next reconstruction.
TEST(Rupture, ThatLeavesAFoldedFilmKeepsTheLiquid) {
  mesh::FilmMesh films;
  films.position = {{0, 0, 0}, {radius, 0, 0}, {0, radius, 0}};
  films.triangle = {mesh::make_triangle(0, 1, 2, 0, 1), mesh::make_triangle(0, 1, 2, 1, 2),
                    mesh::make_triangle(0, 1, 2, 2, 0)};
  Foam foam(std::move(films), 2);
  foam.phases.target_volume = {0, 1e-10, 1e-10};
  ASSERT_EQ(foam.topology.n_borders(), 1);
  const double before = foam.liquid.total();
  foam.tear(1, 2);
  EXPECT_EQ(foam.films.n_triangles(), 2);
  EXPECT_LE(relative_change(before, foam.liquid.total()), 1e-14);
}

TEST(Rupture, WhereThereIsNoFilmIsRefused) {
  Foam foam(shapes::double_bubble(radius, 2), 2);
  EXPECT_THROW(rupture::rupture(1, 3, foam.films, foam.liquid, foam.phases, Fate::Spray, r0),
               std::logic_error);
}

}  // namespace
}  // namespace spume
