#include "spume/flow/surface_tension.hpp"

#include "spume/base/union_find.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::flow {

namespace {

/// Sums of the triangles' area normals at every vertex, and of the directions of the border edges there.
struct Directions {
  std::vector<Vec3> doubled_area, along_border;

  Directions(const mesh::FilmMesh& films, const mesh::Topology& topology)
      : doubled_area(films.position.size()), along_border(films.position.size()) {
    for (int t = 0; t < films.n_triangles(); ++t) {
      const Vec3 normal = mesh::doubled_area_normal(films, t);
      for (int v : films.triangle[t].vertex) doubled_area[v] += normal;
    }
    for (const auto& edge : topology.border_edge) {
      const Vec3 direction = normalized(films.edge(edge.vertex[0], edge.vertex[1]));
      for (int v : edge.vertex)
        along_border[v] += dot(along_border[v], direction) < 0 ? -direction : direction;
    }
  }
};

/// Takes the mean force, by area, out of each connected piece of the films, which then pulls itself nowhere.
void balance(const mesh::FilmMesh& films, std::vector<Vec3>& force) {
  UnionFind piece(films.n_vertices());
  std::vector<double> area(force.size(), 0.0);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto& v = films.triangle[t].vertex;
    piece.join(v[0], v[1]);
    piece.join(v[0], v[2]);
    for (int corner : v) area[corner] += mesh::triangle_area(films, t) / 3;
  }
  std::vector<Vec3> force_of_piece(force.size());
  std::vector<double> area_of_piece(force.size(), 0.0);
  for (int v = 0; v < films.n_vertices(); ++v) {
    force_of_piece[piece.find(v)] += force[v];
    area_of_piece[piece.find(v)] += area[v];
  }
  for (int v = 0; v < films.n_vertices(); ++v) {
    const int p = piece.find(v);
    if (area_of_piece[p] > 0) force[v] -= area[v] / area_of_piece[p] * force_of_piece[p];
  }
}

/// Leaves of the force on a vertex inside a film what is normal to the film, and of that on a border what is
/// normal to the border.
void take_out_sliding(const mesh::FilmMesh& films, const mesh::Topology& topology, std::vector<Vec3>& force) {
  const Directions directions(films, topology);
  for (int v = 0; v < films.n_vertices(); ++v) {
    if (topology.vertex_kind[v] == mesh::VertexKind::Film && topology.vertex_phases[v].size() == 2) {
      const Vec3 n = normalized(directions.doubled_area[v]);
      force[v] = dot(force[v], n) * n;
    } else if (topology.vertex_kind[v] == mesh::VertexKind::Border) {
      const Vec3 t = normalized(directions.along_border[v]);
      force[v] -= dot(force[v], t) * t;
    }
  }
  balance(films, force);
}

}  // namespace

FilmForces film_forces(const mesh::FilmMesh& films, const mesh::Topology& topology, int n_phases,
                       double surface_tension) {
  const double tension = 2 * surface_tension;  // of a film, which has two faces [N/m]
  FilmForces forces{mesh::area_descent(films), {}};
  for (Vec3& f : forces.on_vertex) f *= tension;
  forces.pressure = mesh::film_pressures(films, topology, forces.on_vertex, n_phases);
  const std::vector<Vec3> of_pressure = mesh::weighted_volume_gradient(films, forces.pressure);
  for (std::size_t v = 0; v < of_pressure.size(); ++v) forces.on_vertex[v] += of_pressure[v];
  take_out_sliding(films, topology, forces.on_vertex);
  return forces;
}

void ForceSpreader::spread(const mesh::FilmMesh& films, const FilmForces& forces,
                           const grid::KernelCoupling& kernel, grid::Sharpening& sharpening,
                           grid::VectorField& density) {
  for (grid::Field& component : on_faces_.components) component.fill(0);
  kernel.spread(films.position, forces.on_vertex, on_faces_);
  sharpening.apply(on_faces_, kernel.placement);
  const grid::Grid& grid = density[0].grid();
  const Index3 n = grid.cells();
  for (int c = 0; c < 3; ++c) {
    ghosted_.update(on_faces_[c]);
    const std::ptrdiff_t up = c == 0 ? 1 : c == 1 ? ghosted_.stride_y() : ghosted_.stride_z();
    const bool walled = grid.box().boundary[c] != grid::Boundary::Periodic;
    double* to = density[c].values().data();
    for (int k = grid.z_begin(); k < grid.z_end(); ++k)
      for (int j = 0; j < n.j; ++j, to += n.i) {
        const double* face = ghosted_.at(0, j, k);
        for (int i = 0; i < n.i; ++i) to[i] = 0.5 * (face[i] + face[i + up]);
        // The upper face of the last cell is the wall, not the mirror image of the lower one.
        if (walled && c == 0) to[n.i - 1] = 0.5 * face[n.i - 1];
        if (walled && ((c == 1 && j == n.j - 1) || (c == 2 && k == n.k - 1)))
          for (int i = 0; i < n.i; ++i) to[i] = 0.5 * face[i];
      }
  }
}

}  // namespace spume::flow
