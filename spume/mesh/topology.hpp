#pragma once

#include <array>
#include <vector>

#include "spume/mesh/film_mesh.hpp"

namespace spume::mesh {

enum class VertexKind { Film, Border, Junction };

/// A connected piece of film between two phases.
struct Lamella {
  Phase phase_a, phase_b;
};
/// A connected line where three lamellae of three phases meet.
struct PlateauBorder {
  std::array<Phase, 3> phases;
  bool closed;                ///< a ring without junction
  std::vector<int> vertices;  ///< along the line, from end to end; a ring repeats its first vertex at the end
};
/// One edge of a Plateau border.
struct BorderEdge {
  std::array<int, 2> vertex;      ///< vertex[0] < vertex[1]
  std::array<int, 2> border_dof;  ///< of the two ends
  int border;
  std::array<int, 3> triangle;  ///< the three that meet here
};
/// Unknown of a film: one per vertex and lamella, since η may differ between lamellae that meet at a border.
struct FilmDof {
  int vertex, lamella;
};
/// Unknown of a border: one per vertex and border (four at a junction).
struct BorderDof {
  int vertex, border;
};

/// The phases and triangles that meet at each vertex.
struct VertexTopology {
  std::vector<PhaseSet> vertex_phases;
  std::vector<VertexKind> vertex_kind;
  std::vector<int> star_offset,
      star_triangle;          ///< triangles of vertex v: star_triangle[star_offset[v] … star_offset[v+1])
  std::vector<int> junction;  ///< vertices
};

/// What the film mesh is made of. Derived, in an order that depends on the mesh alone.
struct Topology : VertexTopology {
  // lamellae
  std::vector<Lamella> lamella;
  std::vector<int> triangle_lamella;
  std::vector<FilmDof> film_dof;
  std::vector<std::array<int, 3>> corner_dof;  ///< film dof of each corner of each triangle

  // Plateau borders
  std::vector<PlateauBorder> border;
  std::vector<BorderEdge> border_edge;
  std::vector<BorderDof> border_dof;

  /// Edges that are neither inside one lamella (two triangles, opposite directions) nor on a border (three
  /// triangles of three phase pairs of three phases). Zero in a healthy foam.
  int n_nonconforming_edges = 0;

  int n_lamellae() const { return static_cast<int>(lamella.size()); }
  int n_borders() const { return static_cast<int>(border.size()); }
  int n_junctions() const { return static_cast<int>(junction.size()); }
};

Topology build_topology(const FilmMesh& mesh);
/// The vertices' part of it alone, at a third of the time.
VertexTopology build_vertex_topology(const FilmMesh& mesh);

}  // namespace spume::mesh
