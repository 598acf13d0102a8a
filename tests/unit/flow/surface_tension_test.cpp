#include "spume/flow/surface_tension.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "spume/grid/loops.hpp"
#include "spume/mesh/measure.hpp"
#include "tests/support/film_shapes.hpp"

namespace spume {
namespace {

constexpr double sigma = 0.03;    // [N/m]
constexpr double radius = 0.002;  // 16 h [m]
constexpr double box_length = 0.006;
const Vec3 centre{0.0031, 0.0029, 0.0030};

Vec3 total(std::span<const Vec3> forces) {
  Vec3 sum;
  for (const Vec3& f : forces) sum += f;
  return sum;
}

/// Σ|F_v| [N].
double magnitude(std::span<const Vec3> forces) {
  double sum = 0;
  for (const Vec3& f : forces) sum += norm(f);
  return sum;
}

TEST(SurfaceTension, PressureOfASphereIsThatOfLaplace) {
  const mesh::FilmMesh films = shapes::sphere(centre, radius, 4, 1);  // edges of about radius/14
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  ASSERT_EQ(forces.pressure.size(), 2u);
  EXPECT_EQ(forces.pressure[0], 0.0);
  // A film pulls with 2σ, so its pressure jump is 2·2σ/R. Facets inscribed in the sphere are off by order
  // (edge/R)².
  EXPECT_NEAR(forces.pressure[1], 4 * sigma / radius, 2e-3 * 4 * sigma / radius);
}

TEST(SurfaceTension, PressureOfASphereConvergesWithSecondOrder) {
  std::vector<double> errors;
  for (const int levels : {2, 3, 4}) {
    const mesh::FilmMesh films = shapes::sphere(centre, radius, levels, 1);
    const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
    errors.push_back(std::abs(forces.pressure[1] * radius / (4 * sigma) - 1));
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.2);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.2);
}

TEST(SurfaceTension, ASphereAtRestFeelsAlmostNoForceOnceItsPressureIsTakenOut) {
  const mesh::FilmMesh films = shapes::sphere(centre, radius, 4, 1);
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  double largest = 0, largest_pull = 0;
  std::vector<Vec3> pull = mesh::area_descent(films);
  for (std::size_t v = 0; v < pull.size(); ++v) {
    largest = std::max(largest, norm(forces.on_vertex[v]));
    largest_pull = std::max(largest_pull, 2 * sigma * norm(pull[v]));
  }
  EXPECT_LT(magnitude(forces.on_vertex), 0.01 * 2 * sigma * magnitude(pull));
  // The twelve vertices with five triangles keep most: there area and volume gradients differ in size at any
  // resolution.
  EXPECT_LT(largest, 0.12 * largest_pull);
}

TEST(SurfaceTension, TwoEqualBubblesInEquilibriumHaveThePressureOfTheirCapsAndLittleForceLeft) {
  const double tension = 2 * sigma;
  std::vector<double> errors, left;
  for (const int n : {4, 8}) {
    const mesh::FilmMesh films = shapes::double_bubble(radius, n);
    const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 3, sigma);
    EXPECT_NEAR(forces.pressure[1], forces.pressure[2], 1e-3 * forces.pressure[1]);
    errors.push_back(std::abs(forces.pressure[1] * radius / (2 * tension) - 1));
    left.push_back(magnitude(forces.on_vertex) / (tension * magnitude(mesh::area_descent(films))));
  }
  EXPECT_LT(errors[1], 5e-3);
  EXPECT_LT(errors[1], 0.5 * errors[0]);
  EXPECT_LT(left[1], 0.03);
}

/// Σ of what the forces on vertices inside films have along the film, and on borders along the border [N].
double sliding(const mesh::FilmMesh& films, const mesh::Topology& topology, std::span<const Vec3> force) {
  std::vector<Vec3> normal(force.size()), along(force.size());
  for (int t = 0; t < films.n_triangles(); ++t)
    for (int v : films.triangle[t].vertex) normal[v] += mesh::doubled_area_normal(films, t);
  for (const auto& edge : topology.border_edge) {
    const Vec3 direction = normalized(films.edge(edge.vertex[0], edge.vertex[1]));
    for (int v : edge.vertex) along[v] += dot(along[v], direction) < 0 ? -direction : direction;
  }
  double sum = 0;
  for (std::size_t v = 0; v < force.size(); ++v) {
    const Vec3 n = normalized(normal[v]), t = normalized(along[v]);
    if (topology.vertex_kind[v] == mesh::VertexKind::Film) sum += norm(force[v] - dot(force[v], n) * n);
    if (topology.vertex_kind[v] == mesh::VertexKind::Border) sum += std::abs(dot(force[v], t));
  }
  return sum;
}

TEST(SurfaceTension, DoesNotPullAlongFilmsOrBorders) {
  mesh::FilmMesh films = shapes::double_bubble(radius, 8);
  for (Vec3& x : films.position) x.y *= 0.8 + 0.1 * std::sin(2000 * x.x);
  const mesh::Topology topology = mesh::build_topology(films);
  const flow::FilmForces forces = flow::film_forces(films, topology, 3, sigma);
  std::vector<Vec3> pull = mesh::area_descent(films),
                    of_pressure = mesh::weighted_volume_gradient(films, forces.pressure);
  for (std::size_t v = 0; v < pull.size(); ++v) pull[v] = 2 * sigma * pull[v] + of_pressure[v];
  ASSERT_GT(sliding(films, topology, pull), 0.01 * magnitude(pull));
  // What balances the sum of the forces, spread over all vertices, is left.
  EXPECT_LT(sliding(films, topology, forces.on_vertex), 0.1 * sliding(films, topology, pull));
}

TEST(SurfaceTension, FilmsPullThemselvesNowhere) {
  mesh::FilmMesh films = shapes::sphere(centre, radius, 3, 1);
  for (Vec3& x : films.position) x = {x.x, 0.8 * x.y, x.z + 0.1 * std::sin(3000 * x.x) * radius};
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  EXPECT_GT(magnitude(forces.on_vertex), sigma * radius);
  // Σ F_v of each part is zero in exact arithmetic: translation changes neither area nor volume.
  EXPECT_LT(norm(total(forces.on_vertex)), 1e-13 * 2 * sigma * magnitude(mesh::area_descent(films)));
}

TEST(SurfaceTension, SpreadForceHasTheTotalAndTheMomentOfTheVertexForces) {
  mesh::FilmMesh films = shapes::sphere(centre, radius, 3, 1);
  for (Vec3& x : films.position) x.y *= 0.8;
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  const grid::Grid grid(parallel::Communicator::world(),
                        {{0, 0, 0}, {box_length, box_length, box_length}, {48, 48, 48}, {}});
  grid::VectorField density(grid);
  for (grid::Field& component : density.components) component.fill(7);  // must be overwritten
  grid::Sharpening sharpening(grid);
  flow::ForceSpreader(grid).spread(films, forces, grid::KernelCoupling{}, sharpening, density);
  const double cell = std::pow(grid.h(), 3);
  const double scale = magnitude(forces.on_vertex);
  double stretching = 0, of_vertices = 0;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(cell * sum(density[c]), 0.0, 1e-12 * scale);
  for_each_cell(grid, [&](int i, int j, int k) {
    for (int c = 0; c < 3; ++c)
      stretching += cell * owned(density[c])(i, j, k) * (grid.centre(i, j, k) - centre)[c];
  });
  stretching = grid.communicator().sum(stretching);
  for (std::size_t v = 0; v < films.position.size(); ++v)
    of_vertices += dot(forces.on_vertex[v], films.position[v] - centre);
  // The cosine kernel of half-width 1.5 h has first moments of a few hundredths of h, of alternating sign.
  EXPECT_NEAR(stretching, of_vertices, 0.05 * grid.h() * scale);
  EXPECT_GT(std::abs(of_vertices), 0.1 * grid.h() * scale);
}

}  // namespace
}  // namespace spume
