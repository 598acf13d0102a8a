#include "spume/meshing/local_changes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "spume/meshing/moves.hpp"

namespace spume::meshing {

namespace {

constexpr double least_gain = 1e-3;  // of badness, for a change to be worth it

/// Vertices of the triangles around v but v itself, each once.
std::vector<int> ring_of(const StarMesh& m, int v) {
  std::vector<int> ring;
  for (int t : m.star[v])
    for (int x : m.films.triangle[t].vertex)
      if (x != v) ring.push_back(x);
  std::sort(ring.begin(), ring.end());
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

std::vector<Vec3> directions_in_film(const StarMesh& m, int v) {
  constexpr int n_directions = 8;
  const int t = m.star[v].front();
  const auto& vertex = m.films.triangle[t].vertex;
  const Vec3 u = normalized(m.films.edge(v, vertex[0] == v ? vertex[1] : vertex[0]));
  const Vec3 w = normalized(cross(m.film_normal(t), u));
  std::vector<Vec3> direction;
  for (int n = 0; n < n_directions; ++n) {
    const double angle = 2 * std::numbers::pi * n / n_directions;
    direction.push_back(std::cos(angle) * u + std::sin(angle) * w);
  }
  return direction;
}

std::vector<Vec3> directions_along_border(const StarMesh& m, int v) {
  std::vector<Vec3> direction;
  for (int w : ring_of(m, v))
    if (m.is_border_edge(v, w)) direction.push_back(normalized(m.films.edge(v, w)));
  return direction;
}

}  // namespace

bool LocalChanges::hinge_at(int triangle, int corner, Hinge& hinge) const {
  const auto& vertex = m_.films.triangle[triangle].vertex;
  hinge.left = triangle;
  hinge.a = vertex[corner];
  hinge.b = vertex[(corner + 1) % 3];
  hinge.apex = vertex[(corner + 2) % 3];
  hinge.right = -1;
  for (int t : m_.star[hinge.a]) {
    if (t == triangle || !m_.has(t, hinge.b)) continue;
    if (hinge.right >= 0) return false;  // a border
    hinge.right = t;
  }
  if (hinge.right < 0) return false;
  const auto& other = m_.films.triangle[hinge.right].vertex;
  for (int x : other)
    if (x != hinge.a && x != hinge.b) hinge.beyond = x;
  return hinge.beyond != hinge.apex;
}

/// Badness of the two triangles before and after; false where the new edge exists already.
bool LocalChanges::may_flip(const Hinge& e, double& before, double& after) const {
  if (m_.n_triangles_between(e.apex, e.beyond) > 0) return false;
  const Vec3 normal = m_.film_normal(e.left) + m_.film_normal(e.right);
  const Vec3& a = m_.films.position[e.a];
  const Vec3 b = a + m_.films.edge(e.a, e.b), apex = a + m_.films.edge(e.a, e.apex),
             beyond = a + m_.films.edge(e.a, e.beyond);
  before = std::max(badness({a, b, apex}, normal), badness({b, a, beyond}, normal));
  after = std::max(badness({a, beyond, apex}, normal), badness({b, apex, beyond}, normal));
  return true;
}

/// Whether one of the triangles fills the corner of its film at a junction.
bool LocalChanges::is_filled_corner(const Hinge& e) const {
  const auto fills = [&](int tip) {
    return m_.work.kind(tip) == mesh::VertexKind::Junction && m_.is_border_edge(tip, e.a) &&
           m_.is_border_edge(tip, e.b);
  };
  return fills(e.apex) || fills(e.beyond);
}

void LocalChanges::flip(const Hinge& e) {
  m_.films.triangle[e.left].vertex = {e.a, e.beyond, e.apex};
  m_.films.triangle[e.right].vertex = {e.b, e.apex, e.beyond};
  m_.renew(e.left);
  m_.renew(e.right);
  std::erase(m_.star[e.a], e.right);
  std::erase(m_.star[e.b], e.left);
  m_.star[e.apex].push_back(e.right);
  m_.star[e.beyond].push_back(e.left);
}

bool LocalChanges::flip_if_better(int triangle, int corner) {
  Hinge hinge;
  double before = 0, after = 0;
  if (!hinge_at(triangle, corner, hinge) || is_filled_corner(hinge) || !may_flip(hinge, before, after) ||
      after > before - least_gain)
    return false;
  flip(hinge);
  return true;
}

bool LocalChanges::fill_corner(int triangle, int corner) {
  Hinge e;
  const auto vertex = m_.films.triangle[triangle].vertex;
  const int tip = vertex[corner], inside = vertex[(corner + 1) % 3];
  if (m_.work.kind(tip) != mesh::VertexKind::Junction || m_.work.kind(inside) != mesh::VertexKind::Film ||
      m_.work.held[inside] || !hinge_at(triangle, corner, e))
    return false;
  if (!m_.is_border_edge(tip, e.apex) || !m_.is_border_edge(tip, e.beyond) ||
      m_.n_triangles_between(e.apex, e.beyond) > 0)
    return false;
  if (fills_well(e, m_.films.position[inside], -1)) {
    flip(e);
    return true;
  }
  // The corner's triangle is larger than the two that were there: the vertex between them may have to go.
  for (int w : ring_of(m_, inside)) {
    if (m_.work.kind(w) != mesh::VertexKind::Film || m_.has(e.left, w) || m_.has(e.right, w)) continue;
    if (!keeps_topology(inside, w, m_.n_triangles_between(inside, w))) continue;
    if (!fills_well(e, m_.films.position[inside] + m_.films.edge(inside, w), w)) continue;
    collapse(inside, w);
    e.b = w;
    flip(e);
    return true;
  }
  return false;
}

/// Whether one triangle may fill the corner at e.a, with the vertex e.b at `place`, or drawn into `gone`
/// there if that is not −1.
bool LocalChanges::fills_well(const Hinge& e, const Vec3& place, int gone) const {
  constexpr double least_angle = 24;  // [degrees]; moves and repairs that follow make it better
  const Vec3 tip = m_.films.domain.near(m_.films.position[e.a], place),
             apex = m_.films.domain.near(m_.films.position[e.apex], place),
             beyond = m_.films.domain.near(m_.films.position[e.beyond], place);
  const Vec3 normal = m_.film_normal(e.left) + m_.film_normal(e.right);
  double worst = std::max(badness({tip, beyond, apex}, normal), badness({place, apex, beyond}, normal));
  for (int t : m_.star[e.b])
    if (t != e.left && t != e.right && !(gone >= 0 && m_.has(t, gone)))
      worst = std::max(worst, badness(m_.corners_with(t, e.b, place), m_.film_normal(t)));
  return worst <= badness_of_angle(least_angle);
}

bool LocalChanges::relocate(int v) {
  constexpr int n_sizes = 5;
  const mesh::VertexKind kind = m_.work.kind(v);
  if (m_.work.held[v] || kind == mesh::VertexKind::Junction) return false;
  const Vec3 start = m_.films.position[v];
  const double before = badness_around(m_, v, start);

  double reach = 0;  // a part of the longest edge
  for (int w : ring_of(m_, v)) reach = std::max(reach, 0.3 * norm(m_.films.edge(v, w)));
  const std::vector<Vec3> direction =
      kind == mesh::VertexKind::Film ? directions_in_film(m_, v) : directions_along_border(m_, v);

  Vec3 best = start;
  double least = before;
  for (int n = 0; n < n_sizes; ++n, reach *= 0.5) {
    const Vec3 centre = best;
    for (const Vec3& d : direction) {
      const auto there = project_(centre + reach * d, m_.work.phases[v]);
      if (!there) continue;
      const double worst = badness_around(m_, v, *there);
      if (worst >= least) continue;
      least = worst;
      best = *there;
    }
  }
  if (least > before - least_gain) return false;
  m_.move(v, best);
  return true;
}

void LocalChanges::drop_dead(int v) {
  std::erase_if(m_.star[v], [&](int t) { return m_.dead[t] != 0; });
}

/// The link condition (mesh/collapse.hpp): the neighbours that v and w share are the third corners of the
/// triangles they share, no two edges become one, and no film one triangle wide between two borders closes.
bool LocalChanges::keeps_topology(int v, int w, int n_shared) const {
  const std::vector<int> of_v = ring_of(m_, v), of_w = ring_of(m_, w);
  std::vector<int> common;
  std::set_intersection(of_v.begin(), of_v.end(), of_w.begin(), of_w.end(), std::back_inserter(common));
  if (static_cast<int>(common.size()) != n_shared) return false;
  for (int x : common)
    if (m_.n_triangles_between(v, x) > 2 && m_.n_triangles_between(w, x) > 2) return false;
  // An edge between two common neighbours may be opposite to v or to w, but not to both.
  const auto opposite = [&](int centre, int x, int y) {
    return std::any_of(m_.star[centre].begin(), m_.star[centre].end(), [&](int t) {
      return m_.has(t, x) && m_.has(t, y) && !(m_.has(t, v) && m_.has(t, w));
    });
  };
  for (std::size_t i = 0; i < common.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (opposite(v, common[i], common[j]) && opposite(w, common[i], common[j])) return false;
  return true;
}

bool LocalChanges::keeps_lengths(int v, int w) const {
  constexpr double longest = 1.8;  // × target
  for (int x : ring_of(m_, v))
    if (norm(m_.films.edge(w, x)) > longest * 0.5 * (target_[w] + target_[x])) return false;
  return true;
}

void LocalChanges::collapse(int v, int w) {
  for (int t : m_.star[v]) {
    if (m_.has(t, w)) {
      m_.dead[t] = 1;
      continue;
    }
    auto& vertex = m_.films.triangle[t].vertex;
    std::replace(vertex.begin(), vertex.end(), v, w);
    m_.renew(t);
    m_.star[w].push_back(t);
  }
  for (int x : ring_of(m_, w)) drop_dead(x);
  drop_dead(w);
  m_.star[v].clear();
}

bool LocalChanges::collapse_if_better(int v, int w) {
  if (m_.work.kind(v) == mesh::VertexKind::Junction || m_.work.held[v] ||
      !m_.work.phases[w].contains(m_.work.phases[v]))
    return false;
  const int n_shared = m_.n_triangles_between(v, w);
  if (n_shared != (m_.work.kind(v) == mesh::VertexKind::Border ? 3 : 2)) return false;
  if (!keeps_topology(v, w, n_shared) || !keeps_lengths(v, w)) return false;

  const Vec3 there = m_.films.position[v] + m_.films.edge(v, w);
  double before = 0, after = 0;
  for (int t : m_.star[v]) {
    const Vec3 normal = m_.film_normal(t);
    before = std::max(before, badness(m_.corners(t), normal));
    if (!m_.has(t, w)) after = std::max(after, badness(m_.corners_with(t, v, there), normal));
  }
  if (after > before - least_gain) return false;

  collapse(v, w);
  return true;
}

bool LocalChanges::absorb_if_better(int triangle, int corner) {
  const auto vertex = m_.films.triangle[triangle].vertex;
  const int a = vertex[corner], b = vertex[(corner + 1) % 3], p = vertex[(corner + 2) % 3];
  if (m_.work.kind(p) != mesh::VertexKind::Film || m_.work.held[p] || !m_.is_border_edge(a, b)) return false;

  mesh::PhaseSet phases;
  std::vector<int> beyond;  // the other triangles at the border edge
  for (int t : m_.star[a]) {
    if (!m_.has(t, b)) continue;
    phases.insert(m_.films.triangle[t].phase_a);
    phases.insert(m_.films.triangle[t].phase_b);
    if (t != triangle) beyond.push_back(t);
  }
  const std::vector<int> ring = ring_of(m_, p);
  for (int t : beyond)
    for (int q : m_.films.triangle[t].vertex)
      if (q != a && q != b && std::binary_search(ring.begin(), ring.end(), q)) return false;
  const auto there = project_(m_.films.position[p], phases);
  if (!there) return false;

  double before = 0, after = 0;
  const auto compare = [&](int t, int replaced, bool stays) {
    const Vec3 normal = m_.film_normal(t);
    before = std::max(before, badness(m_.corners(t), normal));
    if (stays) after = std::max(after, badness(m_.corners_with(t, replaced, *there), normal));
  };
  for (int t : m_.star[p]) compare(t, p, t != triangle);
  for (int t : beyond) {
    compare(t, a, true);
    compare(t, b, true);
  }
  if (after > before - least_gain) return false;

  m_.move(p, *there);
  m_.work.phases[p] = phases;
  m_.dead[triangle] = 1;
  for (int x : vertex) drop_dead(x);
  for (int t : beyond) {
    // The triangle becomes the half at a; a new one, the half at b.
    mesh::FilmTriangle second = m_.films.triangle[t];
    std::replace(m_.films.triangle[t].vertex.begin(), m_.films.triangle[t].vertex.end(), b, p);
    std::replace(second.vertex.begin(), second.vertex.end(), a, p);
    const int added = m_.films.n_triangles();
    m_.films.triangle.push_back(second);
    m_.dead.push_back(0);
    m_.renew(t);
    m_.renew(added);
    std::erase(m_.star[b], t);
    m_.star[p].push_back(t);
    for (int x : second.vertex) m_.star[x].push_back(added);
  }
  return true;
}

}  // namespace spume::meshing
