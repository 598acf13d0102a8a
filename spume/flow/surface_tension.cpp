#include "spume/flow/surface_tension.hpp"

#include "spume/base/union_find.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::flow {

namespace {

/// Connected pieces of the films: lamellae that borders join.
std::vector<int> pieces_of_lamellae(const mesh::Topology& topology, int& n_pieces) {
  UnionFind pieces(topology.n_lamellae());
  for (const auto& edge : topology.border_edge)
    for (int t : edge.triangle)
      pieces.join(topology.triangle_lamella[edge.triangle[0]], topology.triangle_lamella[t]);
  std::vector<int> piece_of_lamella;
  n_pieces = pieces.number(piece_of_lamella);
  return piece_of_lamella;
}

/// Adds up to `missing` over each connected piece of the films, spread by area: what was taken out of a
/// closed one would else pull it somewhere.
void give_back(const mesh::FilmMesh& films, const mesh::Topology& topology, const std::vector<Vec3>& missing,
               std::vector<Vec3>& force) {
  int n_pieces = 0;
  const std::vector<int> piece = pieces_of_lamellae(topology, n_pieces);
  std::vector<Vec3> sum(n_pieces);
  std::vector<double> area(n_pieces, 0.0);
  const auto piece_of_triangle = [&](int t) { return piece[topology.triangle_lamella[t]]; };
  for (int v = 0; v < films.n_vertices(); ++v)
    if (topology.star_offset[v] < topology.star_offset[v + 1])
      sum[piece_of_triangle(topology.star_triangle[topology.star_offset[v]])] += missing[v];
  for (int t = 0; t < films.n_triangles(); ++t) area[piece_of_triangle(t)] += mesh::triangle_area(films, t);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const int p = piece_of_triangle(t);
    if (!(area[p] > 0)) continue;
    const Vec3 share = mesh::triangle_area(films, t) / (3 * area[p]) * sum[p];
    for (int v : films.triangle[t].vertex) force[v] += share;
  }
}

/// Leaves of the force on a vertex inside a film what is normal to the film, and of that on a border what is
/// normal to the border; the sum over each connected piece stays.
void take_out_sliding(const mesh::FilmMesh& films, const mesh::Topology& topology, std::vector<Vec3>& force) {
  const std::vector<Vec3> area_normal = mesh::doubled_vertex_normals(films),
                          tangent = mesh::border_tangents(films, topology);
  std::vector<Vec3> taken(force.size());
  for (int v = 0; v < films.n_vertices(); ++v) {
    if (topology.vertex_kind[v] == mesh::VertexKind::Film && topology.vertex_phases[v].size() == 2) {
      const Vec3 n = normalized(area_normal[v]);
      taken[v] = force[v] - dot(force[v], n) * n;
    } else {
      taken[v] = dot(force[v], tangent[v]) * tangent[v];
    }
    force[v] -= taken[v];
  }
  give_back(films, topology, taken, force);
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
