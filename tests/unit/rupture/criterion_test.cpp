#include "spume/rupture/criterion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "spume/mesh/measure.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume {
namespace {

using mesh::VertexKind;
using rupture::Criterion;

constexpr double radius = 1e-3;  // [m]
constexpr double eta0 = 1e-6;    // [m]

/// Four bubbles with uniform η.
state::FilmNetwork uniform_network() {
  state::FilmNetwork network;
  network.mesh = shapes::four_bubbles(radius, 8);
  network.topology = mesh::build_topology(network.mesh);
  network.half_thickness.assign(network.topology.film_dof.size(), eta0);
  return network;
}

double distance_to_junction(const state::FilmNetwork& network, int vertex) {
  double least = 1;
  for (int junction : network.topology.junction)
    least = std::min(least, norm(network.mesh.position[junction] - network.mesh.position[vertex]));
  return least;
}

/// A film dof of the given kind whose vertex is between two distances from the nearest junction [m].
int dof_at(const state::FilmNetwork& network, VertexKind kind, double nearest, double farthest) {
  for (std::size_t d = 0; d < network.topology.film_dof.size(); ++d) {
    const int vertex = network.topology.film_dof[d].vertex;
    const double distance = distance_to_junction(network, vertex);
    if (network.topology.vertex_kind[vertex] == kind && distance >= nearest && distance <= farthest)
      return static_cast<int>(d);
  }
  throw std::logic_error("no such dof");
}

TEST(ThinnestPoint, UnderTheNodeCriterionIsTheThinnestDofWherever) {
  state::FilmNetwork network = uniform_network();
  const int corner = dof_at(network, VertexKind::Junction, 0, 0);
  network.half_thickness[corner] = 0.1 * eta0;
  rupture::RuptureParameters parameters;
  parameters.criterion = Criterion::Node;
  const state::ThinPoint point = rupture::thinnest_point(network, parameters, 0);
  EXPECT_EQ(point.film_dof, corner);
  EXPECT_EQ(point.lamella, network.topology.film_dof[corner].lamella);
  EXPECT_EQ(point.half_thickness, 0.1 * eta0);
  EXPECT_EQ(point.kind, VertexKind::Junction);
}

TEST(ThinnestPoint, UnderTheFilmCriterionIsNotInACornerOfBorders) {
  state::FilmNetwork network = uniform_network();
  rupture::RuptureParameters parameters;
  parameters.corner_radius = 0.3 * radius;
  const int corner = dof_at(network, VertexKind::Junction, 0, 0);
  const int near = dof_at(network, VertexKind::Border, 0.01 * radius, 0.29 * radius);
  const int far = dof_at(network, VertexKind::Border, 0.31 * radius, radius);
  const int inside = dof_at(network, VertexKind::Film, 0.01 * radius, 0.29 * radius);
  network.half_thickness[corner] = 0.1 * eta0;
  network.half_thickness[near] = 0.2 * eta0;
  network.half_thickness[far] = 0.4 * eta0;
  EXPECT_EQ(rupture::thinnest_point(network, parameters, 0).film_dof, far);
  EXPECT_EQ(rupture::thinnest_point(network, parameters, 0).kind, VertexKind::Border);
  // Film vertices count however near to a junction.
  network.half_thickness[inside] = 0.3 * eta0;
  EXPECT_EQ(rupture::thinnest_point(network, parameters, 0).film_dof, inside);
}

TEST(ThinnestPoint, IsNeverInAProtectedFilm) {
  state::FilmNetwork network = uniform_network();
  rupture::RuptureParameters parameters;
  const auto lamella_of = [&](const state::ThinPoint& point) {
    return network.topology.lamella[point.lamella];
  };
  for (std::size_t d = 0; d < network.half_thickness.size(); ++d) {
    const auto& lamella = network.topology.lamella[network.topology.film_dof[d].lamella];
    if (lamella.phase_a == 1 && lamella.phase_b == 3) network.half_thickness[d] = 0.1 * eta0;
    if (lamella.phase_a == 2 && lamella.phase_b == 4) network.half_thickness[d] = 0.2 * eta0;
  }
  EXPECT_EQ(lamella_of(rupture::thinnest_point(network, parameters, 0)).phase_a, 1);
  parameters.protect = {{3, 1}};  // in either order
  EXPECT_EQ(lamella_of(rupture::thinnest_point(network, parameters, 0)).phase_a, 2);
  for (int a = 0; a < 5; ++a)
    for (int b = a + 1; b < 5; ++b) parameters.protect.push_back({a, b});
  EXPECT_EQ(rupture::thinnest_point(network, parameters, 0).film_dof, -1);
}

TEST(ThinnestPoint, IsNotInALamellaTooSmallToHaveAThickness) {
  state::FilmNetwork network = uniform_network();
  const std::vector<double> area = mesh::lamella_areas(network.mesh, network.topology);
  const auto smallest = std::min_element(area.begin(), area.end());
  for (std::size_t d = 0; d < network.half_thickness.size(); ++d)
    if (network.topology.film_dof[d].lamella == smallest - area.begin())
      network.half_thickness[d] = 0.1 * eta0;
  const rupture::RuptureParameters parameters;
  EXPECT_EQ(rupture::thinnest_point(network, parameters, 0.99 * *smallest).lamella, smallest - area.begin());
  EXPECT_EQ(rupture::thinnest_point(network, parameters, 1.01 * *smallest).half_thickness, eta0);
}

TEST(ThinnestPoint, IsNotOnASliver) {
  state::FilmNetwork network = uniform_network();
  // A vertex close to one end of an edge: four slivers or halves, so two small ones around the end get most
  // of theirs from others; a vertex added twice near a middle has only slivers.
  const auto& edge =
      network.mesh
          .triangle
              [network.topology.star_triangle
                   [network.topology.star_offset
                        [network.topology.film_dof[dof_at(network, VertexKind::Film, 0.3 * radius, radius)]
                             .vertex]]]
          .vertex;
  const int a = edge[0], b = edge[1];
  const int first = shapes::split_edge(network.mesh, a, b, 0.5);
  const int second = shapes::split_edge(network.mesh, first, b, 1e-3);
  const int third = shapes::split_edge(network.mesh, first, second, 0.5);
  network.topology = mesh::build_topology(network.mesh);
  network.half_thickness.assign(network.topology.film_dof.size(), eta0);
  for (std::size_t d = 0; d < network.half_thickness.size(); ++d)
    if (network.topology.film_dof[d].vertex == third) network.half_thickness[d] = 0.1 * eta0;
  const rupture::RuptureParameters parameters;
  EXPECT_EQ(rupture::thinnest_point(network, parameters, 0).half_thickness, eta0);
}

}  // namespace
}  // namespace spume
