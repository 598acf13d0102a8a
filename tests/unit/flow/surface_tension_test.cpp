#include "spume/flow/surface_tension.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
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

/// Σ x × F [N m].
Vec3 moment(std::span<const Vec3> position, std::span<const Vec3> force) {
  Vec3 sum;
  for (std::size_t v = 0; v < force.size(); ++v) sum += cross(position[v], force[v]);
  return sum;
}

/// What of the forces is left where all that pulls along films and borders is taken out [N].
std::vector<Vec3> without_sliding(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                  std::vector<Vec3> force) {
  const std::vector<Vec3> normal = mesh::doubled_vertex_normals(films),
                          tangent = mesh::border_tangents(films, topology);
  for (std::size_t v = 0; v < force.size(); ++v) {
    const Vec3 n = normalized(normal[v]);
    force[v] = topology.vertex_kind[v] == mesh::VertexKind::Film
                   ? dot(force[v], n) * n
                   : force[v] - dot(force[v], tangent[v]) * tangent[v];
  }
  return force;
}

/// A translation or a turn changes neither area nor volume: what is taken out of the forces must not pull or
/// turn a closed piece of films either.
void expect_no_sum_and_no_moment(const mesh::FilmMesh& films, std::span<const Vec3> position, int n_phases) {
  const mesh::Topology topology = mesh::build_topology(films);
  const flow::FilmForces forces = flow::film_forces(films, topology, n_phases, sigma);
  const std::vector<Vec3> whole = whole_forces(films, forces.pressure),
                          projected = without_sliding(films, topology, whole);
  const double scale = 2 * sigma * magnitude(mesh::area_descent(films));
  ASSERT_GT(norm(total(projected)), 1e-6 * scale);
  ASSERT_GT(norm(moment(position, projected)), 1e-6 * scale * radius);
  EXPECT_LT(norm(total(forces.on_vertex)), 1e-13 * scale);
  EXPECT_LT(norm(moment(position, forces.on_vertex)), 1e-13 * scale * radius);
}

TEST(SurfaceTension, FilmsNeitherPullNorTurnThemselves) {
  for (mesh::FilmMesh films : {shapes::sphere({}, radius, 3, 1), shapes::four_bubbles(radius, 5)}) {
    for (Vec3& x : films.position)
      x = {x.x, 0.8 * x.y + 0.1 * x.x, x.z + 0.1 * std::sin(2000 * x.x + 1) * radius};
    expect_no_sum_and_no_moment(films, films.position, 5);
    // The same over a corner of a periodic box.
    const std::vector<Vec3> in_one_piece = films.position;
    films.domain = {{0, 0, 0}, {box_length, box_length, box_length}, {true, true, true}};
    for (Vec3& x : films.position) x = films.domain.inside(x);
    expect_no_sum_and_no_moment(films, in_one_piece, 5);
  }
}

TEST(SurfaceTension, FilmsOfRevolutionDoNotTurnThemselvesAboutTheirAxis) {
  // The normals of such films have no moment about the axis, but for those of the triangles.
  mesh::FilmMesh films = shapes::double_bubble(radius, 8);
  const mesh::Topology topology = mesh::build_topology(films);
  for (int v = 0; v < films.n_vertices(); ++v) {
    Vec3& x = films.position[v];
    x += 0.03 * radius * Vec3{std::sin(4000 * x.y), std::sin(4000 * x.z), std::sin(4000 * x.x)};
    x = shapes::on_double_bubble(radius, x, topology.vertex_phases[v]);
  }
  expect_no_sum_and_no_moment(films, films.position, 3);
}

TEST(SurfaceTension, ATubeThroughTheBoxDoesNotTurnItselfAboutItsAxis) {
  constexpr int n_along = 16, n_around = 24;
  mesh::FilmMesh films;
  films.domain = {{0, 0, 0}, {box_length, box_length, box_length}, {true, true, true}};
  for (int i = 0; i < n_along; ++i)
    for (int j = 0; j < n_around; ++j) {
      const double x = i * box_length / n_along, angle = 2 * std::numbers::pi * j / n_around,
                   r = 0.2 * box_length * (1 + 0.1 * ((i * 5 + j * 3) % 4) / 4.0 + 0.2 * std::sin(2 * angle));
      films.position.push_back(
          {x, 0.5 * box_length + r * std::cos(angle), 0.5 * box_length + r * std::sin(angle)});
    }
  const std::vector<Vec3> in_one_piece = films.position;
  for (Vec3& x : films.position) x = films.domain.inside(x + Vec3{0, 0.5 * box_length, 0.4 * box_length});
  const auto at = [](int i, int j) { return i % n_along * n_around + j % n_around; };
  for (int i = 0; i < n_along; ++i)
    for (int j = 0; j < n_around; ++j) {
      films.triangle.push_back(mesh::make_triangle(at(i, j), at(i, j + 1), at(i + 1, j + 1), 1, 0));
      films.triangle.push_back(mesh::make_triangle(at(i, j), at(i + 1, j + 1), at(i + 1, j), 1, 0));
    }
  const mesh::Topology topology = mesh::build_topology(films);
  ASSERT_EQ(topology.n_nonconforming_edges, 0);
  const flow::FilmForces forces = flow::film_forces(films, topology, 2, sigma);
  const std::vector<Vec3> projected = without_sliding(films, topology, whole_forces(films, forces.pressure));
  const double scale = 2 * sigma * magnitude(mesh::area_descent(films));
  ASSERT_GT(std::abs(moment(in_one_piece, projected).x), 1e-6 * scale * box_length);
  EXPECT_LT(std::abs(moment(in_one_piece, forces.on_vertex).x), 1e-13 * scale * box_length);
  EXPECT_LT(norm(total(forces.on_vertex)), 1e-13 * scale);
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
