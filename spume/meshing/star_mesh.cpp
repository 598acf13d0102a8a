#include "spume/meshing/star_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spume::meshing {

double badness(const Corners& corners, const Vec3& film_normal) {
  constexpr double least_cosine = 0.3, turned = 2;
  const Vec3 ab = corners[1] - corners[0], bc = corners[2] - corners[1], ca = corners[0] - corners[2];
  const Vec3 normal = cross(ab, bc);
  const double along = dot(normal, film_normal);
  if (!(along > 0) ||
      along * along < least_cosine * least_cosine * norm_squared(normal) * norm_squared(film_normal))
    return turned;
  const double ab2 = norm_squared(ab), bc2 = norm_squared(bc), ca2 = norm_squared(ca);
  // The smallest angle is opposite to the shortest side.
  if (ab2 <= bc2 && ab2 <= ca2) return -dot(bc, ca) / std::sqrt(bc2 * ca2);
  if (bc2 <= ca2) return -dot(ca, ab) / std::sqrt(ca2 * ab2);
  return -dot(ab, bc) / std::sqrt(ab2 * bc2);
}

double badness_of_angle(double degrees) {
  return std::cos(degrees * std::numbers::pi / 180);
}

StarMesh::StarMesh(mesh::WorkingMesh& working_mesh)
    : work(working_mesh),
      films(working_mesh.mesh),
      star(mesh::vertex_stars(working_mesh.mesh)),
      dead(working_mesh.mesh.n_triangles(), 0),
      normal_(working_mesh.mesh.n_triangles()) {
  for (int t = 0; t < films.n_triangles(); ++t) renew(t);
}

void StarMesh::move(int v, const Vec3& x) {
  films.position[v] = x;
  for (int t : star[v]) renew(t);
}

void StarMesh::renew(int triangle) {
  if (triangle >= static_cast<int>(normal_.size())) normal_.resize(triangle + 1);
  normal_[triangle] = mesh::doubled_area_normal(films, triangle);
}

bool StarMesh::has(int triangle, int v) const {
  const auto& corner = films.triangle[triangle].vertex;
  return corner[0] == v || corner[1] == v || corner[2] == v;
}

int StarMesh::n_triangles_between(int v, int w) const {
  return static_cast<int>(
      std::count_if(star[v].begin(), star[v].end(), [&](int triangle) { return has(triangle, w); }));
}

bool StarMesh::is_near_border(int v) const {
  return std::any_of(star[v].begin(), star[v].end(), [&](int triangle) {
    const auto& corner = films.triangle[triangle].vertex;
    return std::any_of(corner.begin(), corner.end(),
                       [&](int w) { return work.kind(w) != mesh::VertexKind::Film; });
  });
}

Corners StarMesh::corners_with(int triangle, int v, const Vec3& x) const {
  Corners corner;
  for (int c = 0; c < 3; ++c) {
    const int w = films.triangle[triangle].vertex[c];
    corner[c] = w == v ? x : films.domain.near(films.position[w], x);
  }
  return corner;
}

Vec3 StarMesh::film_normal_at(int v, mesh::Phase phase_a, mesh::Phase phase_b) const {
  Vec3 normal;
  for (int s : star[v]) {
    const mesh::FilmTriangle& t = films.triangle[s];
    if (t.phase_a == phase_a && t.phase_b == phase_b) normal += normal_[s];
  }
  return normal;
}

Vec3 StarMesh::film_normal(int triangle) const {
  const mesh::FilmTriangle& t = films.triangle[triangle];
  Vec3 normal;
  for (int v : t.vertex) normal += film_normal_at(v, t.phase_a, t.phase_b);
  return normal;
}

}  // namespace spume::meshing
