#include "spume/simulation/film_source.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "spume/base/error.hpp"
#include "spume/drainage/drain.hpp"
#include "spume/io/film_frame.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/transport/transfer.hpp"

namespace spume::simulation {
namespace {

/// Three rectangles that meet on the axis z, between phases 0, 1 and 2.
mesh::FilmMesh three_walls() {
  mesh::FilmMesh mesh;
  mesh.position = {{0, 0, 0}, {0, 0, 1e-3}};
  for (int film = 0; film < 3; ++film) {
    const double angle = 2 * M_PI * film / 3;
    const Vec3 foot{1e-3 * std::cos(angle), 1e-3 * std::sin(angle), 0};
    const int n = mesh.n_vertices(), from = (film + 2) % 3, into = film;
    mesh.position.push_back(foot);
    mesh.position.push_back(foot + Vec3{0, 0, 1e-3});
    mesh.triangle.push_back(mesh::make_triangle(0, 1, n, from, into));
    mesh.triangle.push_back(mesh::make_triangle(1, n + 1, n, from, into));
  }
  return mesh;
}

state::FilmFrame frame_of(const mesh::FilmMesh& mesh, double eta, double lambda) {
  const auto topology = mesh::build_topology(mesh);
  return io::film_frame(mesh, topology, transport::uniform_liquid(mesh, topology, eta, lambda), 0);
}

/// What the films of a frame are refused for.
std::string complaint(const state::FilmFrame& frame) {
  try {
    join_films(frame, true, 1, 1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FilmSource, gives_back_the_mesh_and_the_liquid_of_a_frame) {
  const auto mesh = three_walls();
  auto frame = frame_of(mesh, 2e-6, 3e-9);
  frame.half_thickness[frame.triangle[4].point[0]] = 7e-6;
  const SourcedFilms sourced = join_films(frame, true, 1, 1);
  EXPECT_EQ(sourced.films.n_vertices(), mesh.n_vertices());
  EXPECT_EQ(sourced.topology.n_borders(), 1);
  EXPECT_EQ(sourced.n_free_edges, 9);
  const auto network = network_of(sourced.films, sourced.liquid);
  EXPECT_NEAR(network.border_area[0], 3e-9, 1e-23);
  int n_thick = 0;
  for (double eta : network.half_thickness) {
    const bool thick = std::abs(eta - 7e-6) < 1e-18;
    n_thick += thick;
    if (!thick) {
      EXPECT_NEAR(eta, 2e-6, 1e-18);
    }
  }
  EXPECT_EQ(n_thick, 1);
}

TEST(FilmSource, takes_uniform_liquid_where_it_is_asked_for) {
  auto frame = frame_of(three_walls(), 2e-6, 3e-9);
  frame.border_point.clear();
  frame.border_line.clear();
  const SourcedFilms sourced = join_films(frame, false, 4e-6, 5e-9);
  EXPECT_NEAR(sourced.liquid.in_lamellae(), 2 * 4e-6 * mesh::film_area(sourced.films), 1e-25);
  EXPECT_NEAR(sourced.liquid.in_borders(), 5e-9 * 1e-3, 1e-25);
}

TEST(FilmSource, drains_without_a_grid_and_lets_nothing_out_where_films_end) {
  const SourcedFilms sourced = join_films(frame_of(three_walls(), 5e-6, 5e-9), true, 1, 1);
  auto network = network_of(sourced.films, sourced.liquid);
  const state::Materials soap{.gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {0, 0, -9.8}};
  const auto outcome =
      drainage::drain(network, soap, {.max_time = 1}, 0, [](const auto&) { return state::ThinPoint{}; }, {});
  EXPECT_EQ(outcome.elapsed, 1);
  EXPECT_LT(std::abs(outcome.ledger_error), 1e-13);
  EXPECT_GT(network.border_area[0], network.border_area[1]);  // vertex 0 is the lower end
}

TEST(FilmSource, says_what_is_wrong_and_where) {
  const auto mesh = three_walls();
  auto frame = frame_of(mesh, 2e-6, 3e-9);
  frame.half_thickness[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(complaint(frame).find("half_thickness_m is nan at ("), std::string::npos) << complaint(frame);

  frame = frame_of(mesh, 2e-6, 3e-9);
  frame.border_point.clear();
  frame.border_line.clear();
  EXPECT_NE(complaint(frame).find("foam.films.liquid = \"uniform\""), std::string::npos);

  frame = frame_of(mesh, 2e-6, 3e-9);
  frame.triangle[0].phase_b = frame.triangle[0].phase_a;
  EXPECT_NE(complaint(frame).find("give two different phases"), std::string::npos);

  frame = frame_of(mesh, 2e-6, 3e-9);
  std::swap(frame.triangle[0].point[0], frame.triangle[0].point[1]);
  EXPECT_NE(complaint(frame).find("disagree"), std::string::npos) << complaint(frame);

  frame = frame_of(mesh, 2e-6, 3e-9);
  frame.triangle.resize(4);  // the third film is gone
  EXPECT_NE(complaint(frame).find("without a third"), std::string::npos) << complaint(frame);

  frame = frame_of(mesh, 2e-6, 3e-9);
  frame.triangle[0].point[2] = frame.triangle[0].point[1];
  EXPECT_NE(complaint(frame).find("no area"), std::string::npos);
}

TEST(FilmSource, refuses_phases_beyond_any_foam) {
  for (const int phase : {7, 100000000, std::numeric_limits<int>::max()}) {
    auto frame = frame_of(three_walls(), 2e-6, 3e-9);  // 6 triangles
    for (auto& t : frame.triangle)
      if (t.phase_b == 2) t.phase_b = phase;
    EXPECT_NE(complaint(frame).find("has the phase " + std::to_string(phase)), std::string::npos)
        << complaint(frame);
  }
  // A fan of triangles that share the origin alone, each around a bubble of its own.
  mesh::FilmMesh fan;
  fan.position = {{0, 0, 0}};
  for (int n = 0; n < 12; ++n) {
    const int v = fan.n_vertices();
    fan.position.push_back({1e-3, 0, n * 1e-4});
    fan.position.push_back({1e-3, 1e-3, n * 1e-4});
    fan.triangle.push_back(mesh::make_triangle(0, v, v + 1, 0, n + 1));
    if (n < 11) {
      EXPECT_EQ(join_films(frame_of(fan, 2e-6, 3e-9), true, 1, 1).n_free_edges, 3 * (n + 1));
    }
  }
  state::FilmFrame thirteen;
  thirteen.film_point = fan.position;
  thirteen.half_thickness.assign(fan.position.size(), 2e-6);
  for (const auto& t : fan.triangle) thirteen.triangle.push_back({t.vertex, 0, t.phase_a, t.phase_b});
  EXPECT_NE(complaint(thirteen).find("more than 12 phases meet at (0, 0, 0) m"), std::string::npos)
      << complaint(thirteen);
}

TEST(FilmSource, refuses_films_that_miss_each_other_in_the_last_digit) {
  // One film of three moves away along y by a billionth of its edges: no border is left.
  auto frame = frame_of(three_walls(), 2e-6, 3e-9);
  for (std::size_t t = 0; t < frame.triangle.size(); ++t)
    for (const int p : frame.triangle[t].point)
      if (norm(frame.film_point[p] - Vec3{0, 0, frame.film_point[p].z}) < 1e-6)
        frame.film_point[p].y = 1e-12 * frame.triangle[t].lamella;
  EXPECT_NE(
      complaint(frame).find("a poly-line runs through (0, 0, 0) m, where no three films meet: points of"),
      std::string::npos)
      << complaint(frame);
  frame.border_point.clear();
  frame.border_area.clear();
  frame.border_line.clear();
  EXPECT_NE(complaint(frame).find("films end at two points 1e-12 m apart at (0, "), std::string::npos)
      << complaint(frame);
  // A slit of a hundredth of an edge is meant.
  for (Vec3& x : frame.film_point)
    if (std::abs(x.y) < 1e-6) x.y *= 1e7;
  EXPECT_EQ(complaint(frame), "");
}

TEST(FilmSource, tells_the_volume_of_what_films_enclose_and_something_positive_of_the_rest) {
  mesh::FilmMesh tetrahedron;
  tetrahedron.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
    tetrahedron.triangle.push_back(mesh::make_triangle(a, b, c, 1, 0));
  EXPECT_NEAR(volumes_of(tetrahedron)[1], 1.0 / 6, 1e-14);
  tetrahedron.triangle.resize(1);
  EXPECT_GT(volumes_of(tetrahedron)[1], 0);
}

}  // namespace
}  // namespace spume::simulation
