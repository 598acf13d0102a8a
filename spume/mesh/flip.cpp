#include "spume/mesh/flip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spume::mesh {
namespace {

constexpr int largest_number_of_rounds = 3;
constexpr double angle_margin = 0.05;  // [rad]
constexpr double least_cosine = 0.5;   // between the normals before and after

using Stars = std::vector<std::vector<int>>;

/// Two triangles of one lamella along the edge from `a` to `b`: the left one has the third corner `left`, the
/// right one, in which the edge runs from `b` to `a`, has `right`.
struct Hinge {
  int left_triangle, right_triangle;
  int a, b, left, right;
};

Hinge hinge_of(const FilmMesh& mesh, const EdgeUse& left, const EdgeUse& right) {
  const auto& l = mesh.triangle[left.triangle].vertex;
  const auto& r = mesh.triangle[right.triangle].vertex;
  return {left.triangle,
          right.triangle,
          l[left.corner],
          l[(left.corner + 1) % 3],
          l[(left.corner + 2) % 3],
          r[(right.corner + 2) % 3]};
}

/// Whether the edge is still the side of both triangles, in opposite directions, inside one film.
bool is_inside_film(const FilmMesh& mesh, const EdgeUse& left, const EdgeUse& right) {
  const FilmTriangle& l = mesh.triangle[left.triangle];
  const FilmTriangle& r = mesh.triangle[right.triangle];
  return l.phase_a == r.phase_a && l.phase_b == r.phase_b &&
         l.vertex[left.corner] == r.vertex[(right.corner + 1) % 3] &&
         l.vertex[(left.corner + 1) % 3] == r.vertex[right.corner];
}

double angle_at(const Vec3& apex, const Vec3& p, const Vec3& q) {
  const Vec3 u = p - apex, v = q - apex;
  return std::atan2(norm(cross(u, v)), dot(u, v));
}

bool are_joined(const FilmMesh& mesh, const Stars& star, int p, int q) {
  return std::any_of(star[p].begin(), star[p].end(), [&](int t) {
    const auto& corner = mesh.triangle[t].vertex;
    return corner[0] == q || corner[1] == q || corner[2] == q;
  });
}

bool flip_improves(const WorkingMesh& work, const Stars& star, const Hinge& e) {
  const Vec3 xa = work.mesh.position[e.a], xb = xa + work.mesh.edge(e.a, e.b),
             left = xa + work.mesh.edge(e.a, e.left), right = xa + work.mesh.edge(e.a, e.right);
  if (e.left == e.right) return false;
  if (work.kind(e.left) != VertexKind::Film && work.kind(e.right) != VertexKind::Film) return false;
  // Two angles that are not obtuse need not be measured.
  if (dot(xa - left, xb - left) >= 0 && dot(xa - right, xb - right) >= 0) return false;
  if (angle_at(left, xa, xb) + angle_at(right, xa, xb) < std::numbers::pi + angle_margin) return false;
  if (are_joined(work.mesh, star, e.left, e.right)) return false;

  const Vec3 before = cross(xb - xa, left - xa) + cross(xa - xb, right - xb);
  const Vec3 at_a = cross(right - xa, left - xa);
  const Vec3 at_b = cross(left - xb, right - xb);
  const double least = least_cosine * norm(before);
  return dot(at_a, before) >= least * norm(at_a) && dot(at_b, before) >= least * norm(at_b);
}

void flip(FilmMesh& mesh, Stars& star, const Hinge& e) {
  mesh.triangle[e.left_triangle].vertex = {e.a, e.right, e.left};
  mesh.triangle[e.right_triangle].vertex = {e.b, e.left, e.right};
  std::erase(star[e.a], e.right_triangle);
  std::erase(star[e.b], e.left_triangle);
  star[e.left].push_back(e.right_triangle);
  star[e.right].push_back(e.left_triangle);
}

/// One round: each triangle takes part in one flip at most, since the edge table is that of the start. Only
/// edges between `open` vertices are looked at; afterwards those of the flipped triangles are open: elsewhere
/// nothing has changed.
int flip_round(WorkingMesh& work, Stars& star, std::vector<char>& open) {
  const EdgeTable edges = build_edges(work.mesh, open);
  open.assign(open.size(), 0);
  std::vector<char> used(work.mesh.n_triangles(), 0);
  int n_flipped = 0;
  for (const MeshEdge& edge : edges.edge) {
    if (edge.n_uses != 2) continue;
    const EdgeUse left = edges.use[edge.first_use], right = edges.use[edge.first_use + 1];
    if (used[left.triangle] || used[right.triangle] || !is_inside_film(work.mesh, left, right)) continue;
    const Hinge hinge = hinge_of(work.mesh, left, right);
    if (!flip_improves(work, star, hinge)) continue;
    flip(work.mesh, star, hinge);
    used[left.triangle] = used[right.triangle] = 1;
    open[hinge.a] = open[hinge.b] = open[hinge.left] = open[hinge.right] = 1;
    ++n_flipped;
  }
  return n_flipped;
}

}  // namespace

int flip_edges(WorkingMesh& work) {
  Stars star = vertex_stars(work.mesh);
  std::vector<char> open(work.mesh.n_vertices(), 1);
  int n_flipped = 0;
  for (int round = 0; round < largest_number_of_rounds; ++round) {
    const int n_this_round = flip_round(work, star, open);
    n_flipped += n_this_round;
    if (n_this_round == 0) break;
  }
  return n_flipped;
}

}  // namespace spume::mesh
