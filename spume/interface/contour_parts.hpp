#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "spume/base/flat_map.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::interface {

/// What a vertex of a contour is known by.
struct VertexKey {
  std::uint64_t simplex;              ///< lowest lattice point and chain of steps
  std::array<mesh::Phase, 4> phases;  ///< increasing, filled up with −1
  bool operator==(const VertexKey&) const = default;
};
struct VertexKeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::uint64_t hash = key.simplex * 0x9E3779B97F4A7C15ull;
    for (mesh::Phase p : key.phases)
      hash = (hash ^ (hash >> 29) ^ static_cast<std::uint64_t>(p + 1)) * 0xBF58476D1CE4E5B9ull;
    return hash ^ (hash >> 32);
  }
};
/// Numbers of vertices.
using VertexNumbers = FlatMap<VertexKey, VertexKeyHash>;

/// A vertex in the plane between the layers of cubes of two ranks.
struct SeamVertex {
  VertexKey key;
  int number;
};
/// The contour of some layers of cubes.
struct ContourPart {
  mesh::FilmMesh films;
  std::vector<SeamVertex> seam;  ///< in the order of their numbers
};

/// The parts of all ranks as one mesh, with every vertex of a seam once, numbered as if one rank had made it
/// all. Collective.
mesh::FilmMesh joined(const parallel::Communicator& ranks, ContourPart part);

}  // namespace spume::interface
