#include "spume/meshing/size_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spume/base/random.hpp"
#include "spume/meshing/rim_widths.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume::meshing {
namespace {

constexpr double radius = 3e-4;  // [m]

SizeField field_of(const mesh::FilmMesh& films, const Sizes& sizes) {
  return {films, mesh::build_topology(films), sizes};
}

TEST(RimWidths, are_those_of_a_strip_and_do_not_count_corners) {
  const double width = 0.1 * radius;
  const mesh::FilmMesh strip = shapes::sliced_ball(radius, width, 0.1 * radius);
  for (const auto& border : rim_widths(strip, mesh::build_topology(strip), radius))
    for (double w : border) EXPECT_NEAR(w / width, 1, 0.02) << "chords of a ring of 60 edges";

  const mesh::FilmMesh cluster = shapes::four_bubbles(radius, 8);
  for (const auto& border : rim_widths(cluster, mesh::build_topology(cluster), 0.5 * radius))
    for (double w : border) EXPECT_EQ(w, 0.5 * radius) << "films as wide as bubbles, corners of 109 degrees";
}

TEST(SizeField, is_fine_at_borders_and_grows_no_faster_than_asked) {
  const mesh::FilmMesh films = shapes::four_bubbles(radius, 8);
  const mesh::Topology topology = mesh::build_topology(films);
  const Sizes sizes{0.3 * radius, 0.1 * radius, 0.02 * radius, 0.01 * radius, 0.25};
  const SizeField size = field_of(films, sizes);
  for (int v = 0; v < films.n_vertices(); ++v) {
    const double s = size(films.position[v]);
    if (topology.vertex_kind[v] == mesh::VertexKind::Junction) {
      EXPECT_EQ(s, sizes.at_junctions);
    } else if (topology.vertex_kind[v] == mesh::VertexKind::Border) {
      EXPECT_LE(s, sizes.at_borders);
    }
  }
  Random random(3);
  const auto point = [&] {
    return radius * Vec3{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)};
  };
  for (int n = 0; n < 500; ++n) {
    const Vec3 a = point(), b = point();
    EXPECT_LE(std::abs(size(a) - size(b)), sizes.grading * norm(a - b) * (1 + 1e-9) + 1e-15 * radius);
  }
  EXPECT_EQ(size({10 * radius, 0, 0}), sizes.in_films);
}

TEST(SizeField, is_the_least_that_any_place_on_a_border_asks_for) {
  const mesh::FilmMesh films = shapes::four_bubbles(radius, 8);
  const mesh::Topology topology = mesh::build_topology(films);
  const Sizes sizes{0.3 * radius, 0.1 * radius, 0.02 * radius, 0.01 * radius, 0.25};
  const SizeField size = field_of(films, sizes);
  double longest = 0;
  for (const auto& e : topology.border_edge)
    longest = std::max(longest, norm(films.edge(e.vertex[0], e.vertex[1])));
  Random random(5);
  for (int n = 0; n < 500; ++n) {
    const Vec3 x =
        radius * Vec3{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)};
    double least = sizes.in_films;
    for (int v = 0; v < films.n_vertices(); ++v)
      if (topology.vertex_kind[v] != mesh::VertexKind::Film)
        least = std::min(least, size(films.position[v]) + sizes.grading * norm(x - films.position[v]));
    EXPECT_LE(size(x), least * (1 + 1e-12));
    EXPECT_GE(size(x), least - sizes.grading * 0.5 * longest) << "places between vertices may be nearer";
  }
}

TEST(SizeField, follows_the_width_of_narrow_films_down_to_a_limit) {
  const mesh::FilmMesh films = shapes::sliced_ball(radius, 0.05 * radius, 0.1 * radius);
  const double rim = std::sqrt(1 - 0.025 * 0.025) * radius;
  const Vec3 on_rim{0.025 * radius, rim, 0};
  EXPECT_NEAR(
      field_of(films, {0.2 * radius, 0.2 * radius, 0.2 * radius, 1e-3 * radius, 0.3})(on_rim) / radius, 0.05,
      2e-3);
  EXPECT_NEAR(
      field_of(films, {0.2 * radius, 0.2 * radius, 0.2 * radius, 0.08 * radius, 0.3})(on_rim) / radius, 0.08,
      1e-6);
}

TEST(SizeField, continues_through_periodic_faces) {
  mesh::FilmMesh films = shapes::double_bubble(radius, 4);
  films.domain = {{-1.6 * radius, -1.05 * radius, -2 * radius},
                  {3.2 * radius, 2.1 * radius, 4 * radius},
                  {false, true, false}};
  const SizeField size = field_of(films, {0.5 * radius, 0.1 * radius, 0.1 * radius, 0.01 * radius, 0.5});
  const Vec3 x{0, 1.0 * radius, 0};
  EXPECT_NEAR(size(x), size(x - Vec3{0, 2.1 * radius, 0}), 1e-12 * radius);
  EXPECT_LT(size({0, 1.0 * radius, 0}), size({0, 1.0 * radius, 0.6 * radius}) + 1e-12);
}

}  // namespace
}  // namespace spume::meshing
