#pragma once

#include <span>
#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::mesh {

/// The largest distance between points of the same number [m].
double largest_distance(std::span<const Vec3> a, std::span<const Vec3> b);
/// Σ of triangle areas, every film once [m²].
double film_area(const FilmMesh& mesh);
/// Volume of every phase by the divergence theorem [m³], indexed by phase; the entry of the outside is minus
/// the rest. Not a number for a bubble that goes through a periodic box in all three directions; minus what
/// they enclose for one that is around all its films.
std::vector<double> phase_volumes(const FilmMesh& mesh, int n_phases);
/// Area of the films of each phase [m²], indexed by phase.
std::vector<double> phase_areas(const FilmMesh& mesh, int n_phases);
/// Area of each lamella [m²].
std::vector<double> lamella_areas(const FilmMesh& mesh, const Topology& topology);
/// Lumped area of every film dof: a third of its lamella's triangles at that vertex [m²].
std::vector<double> film_dof_areas(const FilmMesh& mesh, const Topology& topology);
/// Lumped length of every border dof: half of its border's edges at that vertex [m].
std::vector<double> border_dof_lengths(const FilmMesh& mesh, const Topology& topology);
/// Length of each border [m].
std::vector<double> border_lengths(const FilmMesh& mesh, const Topology& topology);

/// Area-weighted unit normal of every film dof, from the lamella's phase_a into phase_b.
std::vector<Vec3> film_dof_normals(const FilmMesh& mesh, const Topology& topology);

/// Σ over the triangles at each vertex of twice their area times their normals, phase_a to phase_b [m²]:
/// along the normal of the film at vertices inside one.
std::vector<Vec3> doubled_vertex_normals(const FilmMesh& mesh);

/// Unit tangent of the border at every vertex inside one; zero at all others, where borders meet or touch,
/// and where a border turns back on itself, by more than 150 degrees.
std::vector<Vec3> border_tangents(const FilmMesh& mesh, const Topology& topology);

/// −∂A/∂x_v of the whole film area [m]: times the film tension 2σ this is the force on the vertex.
std::vector<Vec3> area_descent(const FilmMesh& mesh);
/// Σ over the triangles at each vertex of (value_a − value_b) A n/3 = Σ_i value_i ∂V_i/∂x_v, for one value
/// per phase.
std::vector<Vec3> weighted_volume_gradient(const FilmMesh& mesh, std::span<const double> value_of_phase);

/// The pressures P_i [Pa for forces in N], P_0 = 0, that take the most out of vertex forces F_v as Σ_i P_i
/// ∂V_i/∂x_v:
///   Σ_v N_i·Σ_j P_j ∂V_j/∂x_v = −Σ_v N_i·F_v   for every bubble i, over film vertices,
/// N_i the unit normal out of bubble i. A weighted graph Laplacian of film areas. In equilibrium F + Σ P
/// ∂V/∂x = 0. A group of phases that no film connects to the outside gets pressures whose mean, weighted by
/// volume, is zero; a bubble without a vertex inside a film gets pressure 0.
std::vector<double> film_pressures(const FilmMesh& mesh, const VertexTopology& topology,
                                   std::span<const Vec3> force, int n_phases);

}  // namespace spume::mesh
