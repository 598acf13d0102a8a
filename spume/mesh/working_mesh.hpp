#pragma once

#include <compare>
#include <span>
#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/remesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::mesh {

/// A side of a triangle: from its vertex[corner] to the next one.
struct EdgeUse {
  int triangle, corner;
};
/// An edge of the mesh, low < high, and its uses: EdgeTable::use[first_use … first_use + n_uses).
struct MeshEdge {
  int low, high;
  int first_use, n_uses;
};
/// An edge by its length, low < high: sorted, short ones come first, and equals in the order of vertices.
struct EdgeLength {
  double length_squared;  ///< [m²]
  int low, high;
  auto operator<=>(const EdgeLength&) const = default;
};
/// All edges in the order of (low, high); the uses of each in triangle order.
struct EdgeTable {
  std::vector<MeshEdge> edge;
  std::vector<EdgeUse> use;

  std::span<const EdgeUse> uses(const MeshEdge& e) const {
    return std::span(use).subspan(e.first_use, e.n_uses);
  }
};
EdgeTable build_edges(const FilmMesh& mesh);

/// Triangles at each vertex, in increasing order; those that may change.
std::vector<std::vector<int>> vertex_stars(const FilmMesh& mesh);
/// The same in one piece, to be read only.
class VertexStars {
 public:
  explicit VertexStars(const FilmMesh& mesh);
  std::span<const int> operator[](int v) const {
    return {triangle_.data() + offset_[v], triangle_.data() + offset_[v + 1]};
  }

 private:
  std::vector<int> offset_, triangle_;
};

/// Wanted edge length at each vertex [m].
std::vector<double> targets_at_vertices(const FilmMesh& mesh, const TargetLength& target);

/// Edges shorter than a fraction of their target, the mean of those at their ends; each once, sorted.
std::vector<EdgeLength> edges_below(const FilmMesh& mesh, const std::vector<double>& target_at_vertex,
                                    double fraction);

/// A mesh while it is being remeshed, with what every operation must keep up to date.
struct WorkingMesh {
  /// The first n_cut vertices are used by triangles that are not in this mesh, which is a part of another:
  /// see parts.hpp.
  explicit WorkingMesh(FilmMesh& film_mesh, int n_cut = 0);

  /// By the number of phases: precedence is in the order of the enumeration.
  VertexKind kind(int v) const {
    return phases[v].size() <= 2   ? VertexKind::Film
           : phases[v].size() == 3 ? VertexKind::Border
                                   : VertexKind::Junction;
  }
  /// Whether a vertex is on the cut around a part: it stays as it is and keeps its number, and what is known
  /// of its triangles is not all.
  bool is_cut(int v) const { return v < n_cut; }
  /// Adds a vertex and gives its number.
  int add_vertex(const Vec3& position, const PhaseSet& vertex_phases, bool is_held);
  /// Removes the marked triangles and the vertices that nothing uses any more, none of which is on a cut.
  void remove(const std::vector<char>& dead_triangle);

  FilmMesh& mesh;
  int n_cut;
  std::vector<PhaseSet> phases;  ///< that meet at each vertex
  std::vector<char>
      held;  ///< vertices on a cut or an edge of a single triangle, where a film ends: they stay as they are
};

}  // namespace spume::mesh
