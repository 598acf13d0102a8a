#include "spume/flow/surface_tension.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "spume/grid/loops.hpp"
#include "spume/mesh/measure.hpp"

namespace spume {
namespace {

using std::numbers::pi;

/// A sphere (phase 1 in phase 0) of radius r: an octahedron divided `levels` times.
mesh::FilmMesh sphere(double r, const Vec3& centre, int levels) {
  std::vector<Vec3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<int, 3>> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::array<int, 2>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [place, is_new] = middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(points.size()));
      if (is_new) points.push_back(normalized(points[a] + points[b]));
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  mesh::FilmMesh films;
  for (const Vec3& p : points) films.position.push_back(centre + r * p);
  for (const auto& [a, b, c] : faces) films.triangle.push_back(mesh::make_triangle(a, b, c, 1, 0));
  return films;
}

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
  const mesh::FilmMesh films = sphere(radius, centre, 5);  // edges of about radius/20
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  ASSERT_EQ(forces.pressure.size(), 2u);
  EXPECT_EQ(forces.pressure[0], 0.0);
  // A film pulls with 2σ, so its pressure jump is 2·2σ/R. Facets inscribed in the sphere are off by order (edge/R)².
  EXPECT_NEAR(forces.pressure[1], 4 * sigma / radius, 2e-3 * 4 * sigma / radius);
}

TEST(SurfaceTension, PressureOfASphereConvergesWithSecondOrder) {
  std::vector<double> errors;
  for (const int levels : {3, 4, 5}) {
    const mesh::FilmMesh films = sphere(radius, centre, levels);
    const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
    errors.push_back(std::abs(forces.pressure[1] * radius / (4 * sigma) - 1));
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.2);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.2);
}

TEST(SurfaceTension, ASphereAtRestFeelsAlmostNoForceOnceItsPressureIsTakenOut) {
  const mesh::FilmMesh films = sphere(radius, centre, 5);
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  double largest = 0, largest_pull = 0;
  std::vector<Vec3> pull = mesh::area_descent(films);
  for (std::size_t v = 0; v < pull.size(); ++v) {
    largest = std::max(largest, norm(forces.on_vertex[v]));
    largest_pull = std::max(largest_pull, 2 * sigma * norm(pull[v]));
  }
  EXPECT_LT(magnitude(forces.on_vertex), 0.01 * 2 * sigma * magnitude(pull));
  EXPECT_LT(largest, 0.05 * largest_pull);
}

TEST(SurfaceTension, FilmsPullThemselvesNowhere) {
  mesh::FilmMesh films = sphere(radius, centre, 4);
  for (Vec3& x : films.position) x = {x.x, 0.8 * x.y, x.z + 0.1 * std::sin(3000 * x.x) * radius};
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  EXPECT_GT(magnitude(forces.on_vertex), sigma * radius);
  // Σ F_v of each part is zero in exact arithmetic: translation changes neither area nor volume.
  EXPECT_LT(norm(total(forces.on_vertex)), 1e-13 * 2 * sigma * magnitude(mesh::area_descent(films)));
}

TEST(SurfaceTension, SpreadForceHasTheTotalAndTheMomentOfTheVertexForces) {
  mesh::FilmMesh films = sphere(radius, centre, 4);
  for (Vec3& x : films.position) x.y *= 0.8;
  const flow::FilmForces forces = flow::film_forces(films, mesh::build_topology(films), 2, sigma);
  const grid::Grid grid(parallel::Communicator::world(),
                        {{0, 0, 0}, {box_length, box_length, box_length}, {48, 48, 48}, {}});
  grid::VectorField density(grid);
  for (grid::Field& component : density.components) component.fill(7);  // must be overwritten
  flow::spread_film_forces(films, forces, grid::KernelCoupling{}, density);
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
