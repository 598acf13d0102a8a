#pragma once

#include <gtest/gtest.h>

#include "spume/mesh/film_mesh.hpp"

namespace spume::testing {

/// The same triangles between the same points, to the last bit.
inline void assert_same_mesh(const mesh::FilmMesh& a, const mesh::FilmMesh& b) {
  ASSERT_EQ(a.n_vertices(), b.n_vertices());
  ASSERT_EQ(a.n_triangles(), b.n_triangles());
  for (int t = 0; t < b.n_triangles(); ++t) ASSERT_EQ(a.triangle[t].vertex, b.triangle[t].vertex);
  for (int v = 0; v < b.n_vertices(); ++v) ASSERT_EQ(norm(a.position[v] - b.position[v]), 0.0) << v;
}

}  // namespace spume::testing
