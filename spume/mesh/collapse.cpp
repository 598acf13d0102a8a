#include "spume/mesh/collapse.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace spume::mesh {
namespace {

constexpr int largest_number_of_passes = 6;
constexpr int block_size = 4096;  // vertices with consecutive numbers, about what a cache holds
constexpr double tiny_edge_reach =
    2.2;                              // × target: the longest edge that the collapse of a tiny one may make
constexpr double least_cosine = 0.7;  // between a triangle and the film around it, after a collapse
constexpr double least_cosine_when_tiny = 0.3;  // the same, when a tiny edge goes
constexpr double sliver_shape = 0.15;  // twice the area over the longest edge squared; 0.87 is equilateral

using Corners = std::array<Vec3, 3>;

Vec3 doubled_area_normal_of(const Corners& p) {
  return cross(p[1] - p[0], p[2] - p[0]);
}

double longest_edge_squared(const Corners& p) {
  return std::max({norm_squared(p[1] - p[0]), norm_squared(p[2] - p[1]), norm_squared(p[0] - p[2])});
}

/// Cosine of the angle between two vectors of known lengths, −1 where one of them has none.
double cosine(const Vec3& a, double length_a, const Vec3& b, double length_b) {
  return length_a > 0 && length_b > 0 ? dot(a, b) / (length_a * length_b) : -1;
}

/// A collapse of v into w under examination.
struct Candidate {
  int v, w;
  double target;  // edge length wanted here
  bool tiny;      // the edge is tiny, or v is a film vertex of three triangles
};

class Collapser {
 public:
  Collapser(WorkingMesh& work, const TargetLength& target, const RemeshParameters& parameters)
      : work_(work),
        mesh_(work.mesh),
        parameters_(parameters),
        target_(targets_at_vertices(work.mesh, target)),
        star_(vertex_stars(work.mesh)),
        dead_triangle_(work.mesh.n_triangles(), 0),
        dead_vertex_(work.mesh.n_vertices(), 0),
        normal_(work.mesh.n_vertices()),
        mark_(work.mesh.n_vertices(), 0) {
    for (int v = 0; v < mesh_.n_vertices(); ++v) kind_.push_back(work_.kind(v));
    for (int t = 0; t < mesh_.n_triangles(); ++t) {
      const Vec3 normal = doubled_area_normal(mesh_, t);
      for (int v : mesh_.triangle[t].vertex)
        if (kind(v) == VertexKind::Film) normal_[v] += normal;
    }
    for (Vec3& n : normal_) n = normalized(n);
  }

  /// Passes over the edges that are too short at the start of each. After the first, only those around what
  /// the last one changed: elsewhere they would be refused again. Ends early when most of the mesh has
  /// changed, which is then better looked at afresh, without the holes in its numbering.
  int run(int& n_passes_left) {
    int n_collapsed = collapse_listed(short_edges());
    while (--n_passes_left > 0 && !grown_.empty() && changed_little()) {
      const std::vector<int> changed = changed_vertices();
      grown_.clear();
      for (int v : changed) measure(v);
      n_collapsed += collapse_listed(short_edges_at(changed));
    }
    if (grown_.empty()) n_passes_left = 0;
    if (n_collapsed > 0) work_.remove(dead_triangle_);
    return n_collapsed;
  }

 private:
  bool has(int triangle, int v) const {
    const auto& corner = mesh_.triangle[triangle].vertex;
    return corner[0] == v || corner[1] == v || corner[2] == v;
  }
  double edge_target(int a, int b) const { return 0.5 * (target_[a] + target_[b]); }
  bool hangs_in_three_triangles(int v) const {
    return kind(v) == VertexKind::Film && !work_.held[v] && star_[v].size() == 3;
  }
  VertexKind kind(int v) const { return kind_[v]; }
  bool is_inner_film(int v) const { return kind(v) == VertexKind::Film && !work_.held[v]; }
  void drop_dead_from_star(int v) {
    std::erase_if(star_[v], [&](int t) { return dead_triangle_[t]; });
  }

  bool changed_little() const { return 32 * grown_.size() < star_.size(); }
  bool is_to_go(int low, int high, double length_squared) const {
    const double limit = parameters_.collapse_below * edge_target(low, high);
    return length_squared < limit * limit || hangs_in_three_triangles(low) || hangs_in_three_triangles(high);
  }

  /// Block by block of their lower vertices, which are near each other in memory; in each the shortest first.
  std::vector<EdgeLength> short_edges() const;
  /// Those with an end in `vertices`.
  std::vector<EdgeLength> short_edges_at(const std::vector<int>& vertices) const;
  /// The vertices of all triangles that have moved since the start of the pass.
  std::vector<int> changed_vertices() const;
  /// Star and normal of a vertex, after a pass.
  void measure(int v);
  void fetch_ahead(const std::vector<EdgeLength>& edges, std::size_t n) const;
  int collapse_listed(const std::vector<EdgeLength>& edges);
  bool try_collapse(int v, int w);
  bool is_allowed_by_kind(const Candidate& c, int n_shared) const;
  bool keeps_topology(const Candidate& c, int n_shared);
  bool is_opposite_to(const Candidate& c, int s) const;
  bool keeps_shape(const Candidate& c, int triangle) const;
  bool keeps_orientation(const Candidate& c, int triangle, const Corners& before, const Corners& after) const;
  bool keeps_lengths(const Candidate& c, int triangle, const Corners& after) const;
  void collapse(int v, int w);

  WorkingMesh& work_;
  FilmMesh& mesh_;
  const RemeshParameters& parameters_;
  std::vector<double> target_;  // at vertices
  std::vector<VertexKind> kind_;
  std::vector<std::vector<int>> star_;
  std::vector<char> dead_triangle_, dead_vertex_;
  std::vector<Vec3> normal_;  // of film vertices, at the start of the pass
  std::vector<int> mark_;     // of vertices: scratch of keeps_topology
  int next_mark_ = 1;
  std::vector<int> grown_;  // vertices that took over the triangles of another in this pass
};

std::vector<EdgeLength> Collapser::short_edges() const {
  std::vector<std::vector<EdgeLength>> of_block(mesh_.n_vertices() / block_size + 1);
  for (const FilmTriangle& t : mesh_.triangle)
    for (int c = 0; c < 3; ++c) {
      const int from = t.vertex[c], to = t.vertex[(c + 1) % 3];
      // An edge inside a film runs forward in one triangle and backward in the other.
      if (to < from && (is_inner_film(from) || is_inner_film(to))) continue;
      const auto [low, high] = std::minmax(from, to);
      const double length_squared = norm_squared(mesh_.edge(low, high));
      if (is_to_go(low, high, length_squared))
        of_block[low / block_size].push_back({length_squared, low, high});
    }
  std::vector<EdgeLength> edges;
  for (auto& block : of_block) {
    std::sort(block.begin(), block.end());
    edges.insert(edges.end(), block.begin(), std::unique(block.begin(), block.end()));
  }
  return edges;
}

std::vector<EdgeLength> Collapser::short_edges_at(const std::vector<int>& vertices) const {
  std::vector<EdgeLength> edges;
  for (int v : vertices)
    for (int t : star_[v])
      for (int x : mesh_.triangle[t].vertex) {
        if (x == v) continue;
        const auto [low, high] = std::minmax(v, x);
        const double length_squared = norm_squared(mesh_.edge(low, high));
        if (is_to_go(low, high, length_squared)) edges.push_back({length_squared, low, high});
      }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<int> Collapser::changed_vertices() const {
  std::vector<int> changed;
  for (int w : grown_)
    for (int t : star_[w])
      if (!dead_triangle_[t])
        changed.insert(changed.end(), mesh_.triangle[t].vertex.begin(), mesh_.triangle[t].vertex.end());
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

void Collapser::measure(int v) {
  drop_dead_from_star(v);
  if (kind(v) != VertexKind::Film) return;
  Vec3 normal;
  for (int t : star_[v]) normal += doubled_area_normal(mesh_, t);
  normal_[v] = normalized(normal);
}

/// Edges in the order of their lengths lie anywhere in a block; the processor is told early what comes.
void Collapser::fetch_ahead(const std::vector<EdgeLength>& edges, std::size_t n) const {
  constexpr std::size_t far = 12, near = 6, next = 3;
  if (n + far < edges.size())
    for (int v : {edges[n + far].low, edges[n + far].high}) {
      __builtin_prefetch(&star_[v]);
      __builtin_prefetch(&mesh_.position[v]);
      __builtin_prefetch(&work_.phases[v]);
    }
  if (n + near < edges.size())
    for (int v : {edges[n + near].low, edges[n + near].high}) __builtin_prefetch(star_[v].data());
  if (n + next < edges.size())
    for (int v : {edges[n + next].low, edges[n + next].high})
      for (int t : star_[v]) __builtin_prefetch(&mesh_.triangle[t]);
}

int Collapser::collapse_listed(const std::vector<EdgeLength>& edges) {
  int n_collapsed = 0;
  for (std::size_t n = 0; n < edges.size(); ++n) {
    fetch_ahead(edges, n);
    const EdgeLength& e = edges[n];
    if (dead_vertex_[e.low] || dead_vertex_[e.high]) continue;
    drop_dead_from_star(e.low);
    drop_dead_from_star(e.high);
    int v = e.low, w = e.high;  // v goes: the one of lower precedence, or else a needless one
    if (kind(w) < kind(v) || (kind(w) == kind(v) && hangs_in_three_triangles(w))) std::swap(v, w);
    n_collapsed += try_collapse(v, w) || (kind(v) == kind(w) && try_collapse(w, v));
  }
  return n_collapsed;
}

bool Collapser::try_collapse(int v, int w) {
  const double target = edge_target(v, w);
  const bool tiny = norm(mesh_.edge(v, w)) < parameters_.tiny * target;
  const Candidate c{v, w, target, tiny || hangs_in_three_triangles(v)};

  const auto n_shared =
      static_cast<int>(std::count_if(star_[v].begin(), star_[v].end(), [&](int t) { return has(t, w); }));
  if (!is_allowed_by_kind(c, n_shared) || !keeps_topology(c, n_shared)) return false;
  for (int t : star_[v])
    if (!has(t, w) && !keeps_shape(c, t)) return false;
  collapse(v, w);
  return true;
}

bool Collapser::is_allowed_by_kind(const Candidate& c, int n_shared) const {
  if (kind(c.v) == VertexKind::Junction || work_.held[c.v] || work_.is_cut(c.w)) return false;
  if (kind(c.v) == VertexKind::Film) return n_shared == 2;  // whose phases then meet at w, too
  return n_shared == 3 && work_.phases[c.w].contains(work_.phases[c.v]);
}

/// The link condition: the neighbours that v and w share are the third corners of the triangles they share,
/// and no edge is opposite to both.
bool Collapser::keeps_topology(const Candidate& c, int n_shared) {
  const int of_v = next_mark_, of_both = next_mark_ + 1;
  next_mark_ += 2;
  const auto for_ring = [&](int centre, auto&& body) {
    for (int t : star_[centre])
      for (int x : mesh_.triangle[t].vertex)
        if (x != c.v && x != c.w) body(x);
  };
  for_ring(c.v, [&](int x) { mark_[x] = of_v; });
  int n_common = 0;
  for_ring(c.w, [&](int x) {
    if (mark_[x] != of_v) return;
    mark_[x] = of_both;
    ++n_common;
  });
  if (n_common != n_shared) return false;

  const auto n_films = [&](int a, int b) {
    return std::count_if(star_[a].begin(), star_[a].end(), [&](int t) { return has(t, b); });
  };
  for (int t : star_[c.v]) {
    if (!has(t, c.w)) continue;
    // A film one triangle wide between two borders: they would become one edge of four films.
    for (int x : mesh_.triangle[t].vertex)
      if (x != c.v && x != c.w && n_films(c.v, x) > 2 && n_films(c.w, x) > 2) return false;
  }
  for (int s : star_[c.w]) {
    int n_marked = 0;
    for (int x : mesh_.triangle[s].vertex) n_marked += x != c.v && x != c.w && mark_[x] == of_both;
    if (n_marked == 2 && is_opposite_to(c, s)) return false;
  }
  return true;
}

/// Whether the edge of triangle s opposite to w is opposite to v too, in a triangle without w.
bool Collapser::is_opposite_to(const Candidate& c, int s) const {
  return std::any_of(star_[c.v].begin(), star_[c.v].end(), [&](int t) {
    if (has(t, c.w)) return false;
    int n_same = 0;
    for (int x : mesh_.triangle[t].vertex) n_same += x != c.v && has(s, x);
    return n_same == 2;
  });
}

/// Whether a triangle of v stays a decent part of its film when v moves to w.
bool Collapser::keeps_shape(const Candidate& c, int triangle) const {
  Corners before, after;
  for (int n = 0; n < 3; ++n) {
    const int x = mesh_.triangle[triangle].vertex[n];
    before[n] = mesh_.domain.near(mesh_.position[x], mesh_.position[c.v]);
    after[n] = mesh_.domain.near(mesh_.position[x == c.v ? c.w : x], mesh_.position[c.v]);
  }
  if (!keeps_orientation(c, triangle, before, after) || !keeps_lengths(c, triangle, after)) return false;
  if (c.tiny) return true;
  // Compared as products, since a triangle of three equal points has no shape.
  const double long_before = longest_edge_squared(before), long_after = longest_edge_squared(after);
  const double area_before = norm(doubled_area_normal_of(before));
  const double area_after = norm(doubled_area_normal_of(after));
  return area_after >= sliver_shape * long_after || area_after * long_before >= area_before * long_after;
}

/// A turned normal refuses a collapse only if the triangle also gets worse than it was: slivers, of which
/// borders of a fresh contour are full, have no normal to keep.
bool Collapser::keeps_orientation(const Candidate& c, int triangle, const Corners& before,
                                  const Corners& after) const {
  const Vec3 n_before = doubled_area_normal_of(before), n_after = doubled_area_normal_of(after);
  const double a_before = norm(n_before), a_after = norm(n_after);
  const double h2 = c.target * c.target;

  Vec3 film_normal;
  for (int x : mesh_.triangle[triangle].vertex) film_normal += normal_[x];
  const double length = norm(film_normal);
  if (length <=
      0.3)  // corners on borders only, or normals that cancel: nothing but its own normal to compare with
    return a_before <= 1e-3 * h2 || dot(n_before, n_after) >= least_cosine * a_before * a_after;

  const double limit = c.tiny ? least_cosine_when_tiny : least_cosine;
  const double cos_before = cosine(n_before, a_before, film_normal, length);
  const double cos_after = cosine(n_after, a_after, film_normal, length);
  const bool gets_worse = cos_after < cos_before + 1e-9;
  const bool counts = a_after > 1e-2 * h2 || cos_before > limit;
  return !(cos_after < limit && gets_worse && counts);
}

bool Collapser::keeps_lengths(const Candidate& c, int triangle, const Corners& after) const {
  double limit = parameters_.no_edge_beyond;
  if (parameters_.split_above > 0) limit = std::min(limit, parameters_.split_above);
  if (c.tiny) limit = std::max(limit, tiny_edge_reach);
  for (int n = 0; n < 3; ++n) {
    const int m = (n + 1) % 3;
    const int a = mesh_.triangle[triangle].vertex[n], b = mesh_.triangle[triangle].vertex[m];
    const double longest = limit * edge_target(a == c.v ? c.w : a, b == c.v ? c.w : b);
    if (norm_squared(after[m] - after[n]) > longest * longest) return false;
  }
  return true;
}

void Collapser::collapse(int v, int w) {
  for (int t : star_[v]) {
    if (dead_triangle_[t]) continue;
    if (has(t, w)) {
      dead_triangle_[t] = 1;
      continue;
    }
    std::replace(mesh_.triangle[t].vertex.begin(), mesh_.triangle[t].vertex.end(), v, w);
    star_[w].push_back(t);
  }
  star_[v].clear();
  dead_vertex_[v] = 1;
  grown_.push_back(w);
}

}  // namespace

int collapse_short_edges(WorkingMesh& work, const TargetLength& target, const RemeshParameters& parameters) {
  int n_collapsed = 0;
  for (int n_passes_left = largest_number_of_passes; n_passes_left > 0;)
    n_collapsed += Collapser(work, target, parameters).run(n_passes_left);
  return n_collapsed;
}

}  // namespace spume::mesh
