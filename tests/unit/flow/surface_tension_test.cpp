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
  const std::vector<Vec3> normal = mesh::doubled_vertex_normals(films),
                          tangent = mesh::border_tangents(films, topology);
  double sum = 0;
  for (std::size_t v = 0; v < force.size(); ++v) {
    const Vec3 n = normalized(normal[v]);
    if (topology.vertex_kind[v] == mesh::VertexKind::Film) sum += norm(force[v] - dot(force[v], n) * n);
    if (topology.vertex_kind[v] == mesh::VertexKind::Border) sum += std::abs(dot(force[v], tangent[v]));
  }
  return sum;
}

/// −2σ ∂A/∂x_v less the pressure part, nothing else taken out [N].
std::vector<Vec3> whole_forces(const mesh::FilmMesh& films, const std::vector<double>& pressure) {
  std::vector<Vec3> force = mesh::area_descent(films),
                    of_pressure = mesh::weighted_volume_gradient(films, pressure);
  for (std::size_t v = 0; v < force.size(); ++v) force[v] = 2 * sigma * force[v] + of_pressure[v];
  return force;
}

TEST(SurfaceTension, DoesNotPullAlongFilmsOrBorders) {
  mesh::FilmMesh films = shapes::double_bubble(radius, 8);
  for (Vec3& x : films.position) x.y *= 0.8 + 0.1 * std::sin(2000 * x.x);
  const mesh::Topology topology = mesh::build_topology(films);
  const flow::FilmForces forces = flow::film_forces(films, topology, 3, sigma);
  const std::vector<Vec3> pull = whole_forces(films, forces.pressure);
  ASSERT_GT(sliding(films, topology, pull), 0.01 * magnitude(pull));
  // What balances the sum of the forces, spread over all vertices, is left.
  EXPECT_LT(sliding(films, topology, forces.on_vertex), 0.1 * sliding(films, topology, pull));
}

TEST(SurfaceTension, ABorderOfThreeVerticesShrinksAsTheFilmThatItHoldsWould) {
  // The last triangle between two bubbles that come apart, the bubbles two tetrahedra on it.
  mesh::FilmMesh films;
  const double r = radius;
  films.position = {
      {r, 0, 0}, {-r / 2, std::sqrt(0.75) * r, 0}, {-r / 2, -std::sqrt(0.75) * r, 0}, {0, 0, r}, {0, 0, -r}};
  films.triangle.push_back(mesh::make_triangle(0, 1, 2, 1, 2));
  for (int v = 0; v < 3; ++v) {
    films.triangle.push_back(mesh::make_triangle((v + 1) % 3, v, 3, 0, 2));
    films.triangle.push_back(mesh::make_triangle(v, (v + 1) % 3, 4, 0, 1));
  }
  const mesh::Topology topology = mesh::build_topology(films);
  ASSERT_EQ(topology.n_borders(), 1);
  ASSERT_EQ(topology.n_nonconforming_edges, 0);
  const flow::FilmForces forces = flow::film_forces(films, topology, 3, sigma);
  const std::vector<Vec3> pull = whole_forces(films, forces.pressure);
  for (int v = 0; v < 3; ++v) {  // by symmetry all of it is normal to the ring
    ASSERT_GT(norm(pull[v]), 0.1 * sigma * r);
    EXPECT_LT(norm(forces.on_vertex[v] - pull[v]), 1e-12 * norm(pull[v]));
  }
}

TEST(SurfaceTension, AFilmThroughTheWholeBoxKeepsTheForceOfItsPressure) {
  constexpr int n = 8;
  mesh::FilmMesh films;
  films.domain = {{0, 0, 0}, {box_length, box_length, box_length}, {true, true, false}};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = i * box_length / n, y = j * box_length / n;
      const double bump = i > 1 && i < 6 && j > 1 && j < 6 ? 0.1 : 0.0;
      films.position.push_back({x, y, (0.5 + bump + 0.01 * ((i * 5 + j * 3) % 4)) * box_length});
    }
  const auto at = [](int i, int j) { return j % n * n + i % n; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      films.triangle.push_back(mesh::make_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), 0, 1));
      films.triangle.push_back(mesh::make_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1), 0, 1));
    }
  const mesh::Topology topology = mesh::build_topology(films);
  ASSERT_EQ(topology.n_nonconforming_edges, 0);
  const flow::FilmForces forces = flow::film_forces(films, topology, 2, sigma);
  const Vec3 sum = total(whole_forces(films, forces.pressure));
  ASSERT_GT(norm(sum), 1e-3 * sigma * box_length);
  EXPECT_LT(norm(total(forces.on_vertex) - sum), 1e-12 * norm(sum));
}

TEST(SurfaceTension, FilmsPullThemselvesNowhere) {
  mesh::FilmMesh films = shapes::sphere(centre, radius, 3, 1);
  for (Vec3& x : films.position) x = {x.x, 0.8 * x.y, x.z + 0.1 * std::sin(3000 * x.x) * radius};
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  EXPECT_GT(magnitude(forces.on_vertex), sigma * radius);
  // A translation changes neither area nor volume, and what is taken out of the forces is given back.
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
