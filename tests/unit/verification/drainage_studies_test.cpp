// The small variants of the drainage studies, and the meshes they stand on.
#include <gtest/gtest.h>

#include <cmath>

#include "spume/mesh/measure.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/verification/drainage_runs.hpp"
#include "spume/verification/exact_clusters.hpp"
#include "spume/verification/film_networks.hpp"
#include "spume/verification/four_bubble_films.hpp"
#include "spume/verification/rim_reference.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {
namespace {

class DrainageStudy : public ::testing::TestWithParam<const char*> {};

TEST_P(DrainageStudy, is_within_its_bands_on_coarse_meshes) {
  const auto& world = parallel::Communicator::world();
  Report report(world);
  for (const Study& study : studies())
    if (study.name == GetParam()) run(study, world, Scale::Small, report);
  EXPECT_GT(report.n_judged(), 0);
  EXPECT_EQ(report.n_outside(), 0);
}

INSTANTIATE_TEST_SUITE_P(All, DrainageStudy,
                         ::testing::Values("film-modes-flat", "film-modes-sphere", "film-modes-cylinder",
                                           "vertical-film", "spherical-film", "border-front",
                                           "border-hydrostatic", "film-rim"));

TEST(FourBubbleFilms, are_the_exact_cluster_with_one_triangle_in_each_corner) {
  const auto exact = equal_cluster(4);
  double coarser = 0;
  auto films = four_bubble_films(1, 0.2);
  for (int level = 0; level < 3; ++level) {
    if (level > 0) films = refine_around(films, mesh::VertexKind::Film, 1, four_bubble_middle(1));
    const auto topology = mesh::build_topology(films);
    EXPECT_EQ(topology.n_lamellae(), 10);
    EXPECT_EQ(topology.n_borders(), 10);
    EXPECT_EQ(topology.n_junctions(), 5);
    EXPECT_EQ(topology.n_nonconforming_edges, 0);
    for (int v : topology.junction)
      EXPECT_EQ(topology.star_offset[v + 1] - topology.star_offset[v], 6);  // as many as films
    const double error = 1 - mesh::film_area(films) / exact.area;
    if (level > 0) {
      EXPECT_NEAR(order_of(coarser, error), 2, 0.1);
    }
    coarser = error;
  }
  EXPECT_LT(std::abs(coarser), 1e-3);
}

TEST(FourBubbleFilms, stay_conforming_and_keep_their_corners_where_borders_are_refined) {
  auto films = four_bubble_films(1, 0.2);
  for (int level = 0; level < 2; ++level)
    films = refine_around(films, mesh::VertexKind::Border, 3, four_bubble_middle(1));
  const auto topology = mesh::build_topology(films);
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  for (int v : topology.junction) EXPECT_EQ(topology.star_offset[v + 1] - topology.star_offset[v], 6);
  const auto quality = mesh::measure_quality(films, topology);
  EXPECT_EQ(quality.n_inverted, 0);
  EXPECT_GT(quality.smallest_angle_degrees, 14);
}

TEST(GeodesicSphere, is_closed_and_has_six_triangles_at_its_poles) {
  const auto sphere = geodesic_sphere(1, 6);
  const auto topology = mesh::build_topology(sphere);
  EXPECT_EQ(sphere.n_triangles(), 20 * 36);
  EXPECT_EQ(sphere.n_vertices(), 10 * 36 + 2);
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  EXPECT_NEAR(mesh::phase_volumes(sphere, 2)[1], 4 * M_PI / 3, 0.02 * 4 * M_PI / 3);
  int n_poles = 0;
  for (int v = 0; v < sphere.n_vertices(); ++v)
    if (std::abs(std::abs(sphere.position[v].z) - 1) < 1e-12) {
      ++n_poles;
      EXPECT_EQ(topology.star_offset[v + 1] - topology.star_offset[v], 6);
    }
  EXPECT_EQ(n_poles, 2);
}

TEST(TetrahedralCorner, meets_in_one_junction_with_one_triangle_a_film) {
  const auto mesh = tetrahedral_corner(0.1, 5);
  const auto topology = mesh::build_topology(mesh);
  EXPECT_EQ(topology.n_lamellae(), 6);
  EXPECT_EQ(topology.n_borders(), 4);
  EXPECT_EQ(topology.n_junctions(), 1);
  EXPECT_EQ(topology.star_offset[1] - topology.star_offset[0], 6);
}

TEST(RimOfFlatFilm, does_not_depend_on_the_grid) {
  const FlatFilm film{.half_width = 0.5e-3, .half_thickness = 5e-6, .border_area = 5e-8};
  const std::vector<double> times{0.1, 4};
  const auto coarse = rim_of_flat_film(film, fig15_materials(), 1e-6, times),
             fine = rim_of_flat_film(film, fig15_materials(), 0.5e-6, times);
  for (std::size_t n = 0; n < times.size(); ++n) EXPECT_NEAR(coarse[n], fine[n], 0.005 * fine[n]);
}

}  // namespace
}  // namespace spume::verification
