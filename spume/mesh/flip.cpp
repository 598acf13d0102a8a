#include "spume/mesh/flip.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace spume::mesh {
namespace {

constexpr int largest_number_of_rounds = 3;
constexpr double angle_margin = 0.05;  // [rad]
constexpr double least_cosine = 0.5;   // between the normals before and after

constexpr EdgeUse nothing{-1, -1};

/// Whether the edge is the side of both triangles, in opposite directions, inside one film.
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

}  // namespace

EdgeFlipper::Hinge EdgeFlipper::hinge_of(const FilmMesh& mesh, const EdgeUse& left, const EdgeUse& right) {
  const auto& l = mesh.triangle[left.triangle].vertex;
  const auto& r = mesh.triangle[right.triangle].vertex;
  return {l[left.corner], l[(left.corner + 1) % 3], l[(left.corner + 2) % 3], r[(right.corner + 2) % 3]};
}

EdgeFlipper::EdgeFlipper(WorkingMesh& work)
    : work_(work), across_(work.mesh.triangle.size(), {nothing, nothing, nothing}) {
  const EdgeTable edges = build_edges(work.mesh);
  for (const MeshEdge& edge : edges.edge) {
    if (edge.n_uses != 2) continue;
    const EdgeUse left = edges.use[edge.first_use], right = edges.use[edge.first_use + 1];
    if (is_inside_film(work.mesh, left, right)) link(left, right);
  }
}

int EdgeFlipper::run() {
  std::vector<EdgeUse> open;
  for (int t = 0; t < work_.mesh.n_triangles(); ++t)
    for (int c = 0; c < 3; ++c)
      if (across_[t][c].triangle > t) open.push_back({t, c});
  int n_flipped = 0;
  for (int round = 0; round < largest_number_of_rounds && !open.empty(); ++round) {
    std::vector<EdgeUse> next;
    for (const EdgeUse& left : open) {
      const EdgeUse right = across_[left.triangle][left.corner];
      if (right.triangle < 0) continue;
      const Hinge hinge = hinge_of(work_.mesh, left, right);
      if (!improves(hinge, left, right)) continue;
      flip(hinge, left, right);
      ++n_flipped;
      for (int t : {left.triangle, right.triangle})
        for (int c : {0, 2}) next.push_back({t, c});
    }
    open = std::move(next);
  }
  return n_flipped;
}

bool EdgeFlipper::improves(const Hinge& e, const EdgeUse& l, const EdgeUse& r) const {
  const Vec3 xa = work_.mesh.position[e.a], xb = xa + work_.mesh.edge(e.a, e.b),
             left = xa + work_.mesh.edge(e.a, e.left), right = xa + work_.mesh.edge(e.a, e.right);
  // Two angles that are not obtuse need not be measured.
  if (dot(xa - left, xb - left) >= 0 && dot(xa - right, xb - right) >= 0) return false;
  if (angle_at(left, xa, xb) + angle_at(right, xa, xb) < std::numbers::pi + angle_margin) return false;
  if (e.left == e.right) return false;
  if (is_inner_film(e.left)) {
    if (is_neighbour({l.triangle, (l.corner + 2) % 3}, e.right)) return false;
  } else if (is_inner_film(e.right)) {
    if (is_neighbour({r.triangle, (r.corner + 2) % 3}, e.left)) return false;
  } else {
    return false;
  }

  const Vec3 before = cross(xb - xa, left - xa) + cross(xa - xb, right - xb);
  const Vec3 at_a = cross(right - xa, left - xa);
  const Vec3 at_b = cross(left - xb, right - xb);
  const double least = least_cosine * norm(before);
  return dot(at_a, before) >= least * norm(at_a) && dot(at_b, before) >= least * norm(at_b);
}

/// Whether a vertex is known to be inside a film: one on a cut may be on a border beyond it, and its
/// triangles there are not known.
bool EdgeFlipper::is_inner_film(int v) const {
  return work_.kind(v) == VertexKind::Film && !work_.is_cut(v);
}

/// Whether an edge joins q to the film vertex at a corner of a triangle; walks around that vertex, both ways
/// where its film ends.
bool EdgeFlipper::is_neighbour(const EdgeUse& start, int q) const {
  const auto vertex = [&](int t, int c) { return work_.mesh.triangle[t].vertex[c % 3]; };
  const int largest_star = work_.mesh.n_triangles();
  EdgeUse at = start;
  for (int n = 0; n < largest_star; ++n) {
    if (vertex(at.triangle, at.corner + 1) == q || vertex(at.triangle, at.corner + 2) == q) return true;
    const EdgeUse next = across_[at.triangle][at.corner];
    if (next.triangle < 0) break;
    at = {next.triangle, (next.corner + 1) % 3};
    if (at.triangle == start.triangle) return false;
  }
  at = start;
  for (int n = 0; n < largest_star; ++n) {
    const EdgeUse next = across_[at.triangle][(at.corner + 2) % 3];
    if (next.triangle < 0 || next.triangle == start.triangle) return false;
    at = next;
    if (vertex(at.triangle, at.corner + 1) == q || vertex(at.triangle, at.corner + 2) == q) return true;
  }
  return false;
}

void EdgeFlipper::flip(const Hinge& e, const EdgeUse& left, const EdgeUse& right) {
  const int l = left.triangle, r = right.triangle;
  const EdgeUse b_left = across_[l][(left.corner + 1) % 3], left_a = across_[l][(left.corner + 2) % 3],
                a_right = across_[r][(right.corner + 1) % 3], right_b = across_[r][(right.corner + 2) % 3];
  work_.mesh.triangle[l].vertex = {e.a, e.right, e.left};
  work_.mesh.triangle[r].vertex = {e.b, e.left, e.right};
  link({l, 0}, a_right);
  link({l, 1}, {r, 1});
  link({l, 2}, left_a);
  link({r, 0}, b_left);
  link({r, 2}, right_b);
}

void EdgeFlipper::link(const EdgeUse& side, const EdgeUse& other) {
  across_[side.triangle][side.corner] = other;
  if (other.triangle >= 0) across_[other.triangle][other.corner] = side;
}

int flip_edges(WorkingMesh& work) {
  return EdgeFlipper(work).run();
}

}  // namespace spume::mesh
