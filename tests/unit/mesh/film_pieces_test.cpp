#include "spume/mesh/film_pieces.hpp"

#include <gtest/gtest.h>

#include "tests/support/film_shapes.hpp"

namespace spume::mesh {
namespace {

constexpr double h = 1e-4;

using Bounded = std::array<bool, 3>;

/// A sheet of n × n squares of edge h that closes through the box along x and y; its far edges meet the near
/// ones `shear` squares further along y.
FilmMesh sheet(int n, int shear) {
  FilmMesh film;
  film.domain = {{0, 0, 0}, {n * h, n * h, n * h}, {true, true, true}};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) film.position.push_back({i * h, ((j + shear * i) % n) * h, 0.5 * n * h});
  const auto at = [&](int i, int j) { return j % n * n + i % n; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      film.triangle.push_back(make_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), 0, 1));
      film.triangle.push_back(make_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1), 0, 1));
    }
  return film;
}

TEST(FilmPieces, LieInOnePieceWhereTheBoxCutsThem) {
  FilmMesh films = shapes::double_bubble(3 * h, 4);
  const FilmMesh sphere = shapes::sphere({8 * h, 1 * h, 0.5 * h}, 2 * h, 2, 3);
  const int n = films.n_vertices();
  for (const FilmTriangle& t : sphere.triangle)
    films.triangle.push_back({{t.vertex[0] + n, t.vertex[1] + n, t.vertex[2] + n}, t.phase_a, t.phase_b});
  films.position.insert(films.position.end(), sphere.position.begin(), sphere.position.end());
  films.position.push_back({});  // of no triangle
  const std::vector<Vec3> whole = films.position;
  films.domain = {{0, 0, 0}, {20 * h, 20 * h, 20 * h}, {true, true, true}};
  for (Vec3& x : films.position) x = films.domain.inside(x);

  const FilmPieces pieces = film_pieces(films, build_topology(films));
  ASSERT_EQ(pieces.count, 2);
  EXPECT_EQ(pieces.of_vertex.back(), -1);
  for (int v = 0; v + 1 < films.n_vertices(); ++v) {
    const int first = v < n ? 0 : n;
    EXPECT_EQ(pieces.of_vertex[v], v < n ? 0 : 1);
    const Vec3 apart = pieces.position[v] - pieces.position[first];
    EXPECT_LT(norm(apart - (whole[v] - whole[first])), 1e-13 * h * 20);  // round-off of positions in the box
  }
  EXPECT_EQ(pieces.position[0], films.position[0]);
  EXPECT_EQ(pieces.bounded[0], (Bounded{true, true, true}));
  EXPECT_EQ(pieces.bounded[1], (Bounded{true, true, true}));
}

TEST(FilmPieces, AFilmThroughTheBoxIsBoundedAcrossItOnly) {
  for (const int shear : {0, 1})
    for (const bool closed_across : {true, false}) {  // without images across, the search may end early
      FilmMesh film = sheet(8, shear);
      film.domain.periodic[2] = closed_across;
      const Topology topology = build_topology(film);
      ASSERT_EQ(topology.n_nonconforming_edges, 0);
      const FilmPieces pieces = film_pieces(film, topology);
      ASSERT_EQ(pieces.count, 1);
      EXPECT_EQ(pieces.bounded[0], (Bounded{false, false, true}));
      for (int v = 0; v < film.n_vertices(); ++v)
        EXPECT_LT(norm(film.domain.step(film.position[v], pieces.position[v])), 1e-13 * h);  // an image
    }
}

TEST(FilmPieces, APieceInTheBoxIsPutTogetherBesideOneThatGoesThroughIt) {
  FilmMesh films = sheet(20, 0);
  films.domain.periodic[2] = false;
  const int n = films.n_vertices();
  const FilmMesh sphere = shapes::sphere({20 * h, 1 * h, 4 * h}, 2 * h, 2, 3);
  for (const FilmTriangle& t : sphere.triangle)
    films.triangle.push_back({{t.vertex[0] + n, t.vertex[1] + n, t.vertex[2] + n}, 0, 2});
  for (const Vec3& x : sphere.position) films.position.push_back(films.domain.inside(x));
  const FilmPieces pieces = film_pieces(films, build_topology(films));
  ASSERT_EQ(pieces.count, 2);
  EXPECT_EQ(pieces.bounded[0], (Bounded{false, false, true}));
  EXPECT_EQ(pieces.bounded[1], (Bounded{true, true, true}));
  for (std::size_t v = 0; v < sphere.position.size(); ++v) {
    const Vec3 apart = pieces.position[n + v] - pieces.position[n];
    EXPECT_LT(norm(apart - (sphere.position[v] - sphere.position[0])), 1e-13 * h * 20);
  }
}

}  // namespace
}  // namespace spume::mesh
