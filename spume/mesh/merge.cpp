#include "spume/mesh/merge.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "spume/base/union_find.hpp"

namespace spume::mesh {
namespace {

constexpr int largest_number_of_passes = 6;
constexpr int largest_group = 12;
constexpr int largest_number_of_phases = 8;  // that may meet at the new vertex

class Merger {
 public:
  Merger(WorkingMesh& work, const TargetLength& target, const RemeshParameters& parameters)
      : work_(work),
        mesh_(work.mesh),
        parameters_(parameters),
        target_(targets_at_vertices(work.mesh, target)),
        dead_triangle_(work.mesh.n_triangles(), 0),
        touched_(work.mesh.n_vertices(), 0) {}

  /// One pass over the mesh as it was at the start: what is next to a merged group waits for the next one.
  int run() {
    const std::vector<EdgeLength> edges = tiny_edges();
    if (edges.empty()) return 0;
    star_.emplace(mesh_);
    UnionFind groups(mesh_.n_vertices());
    for (const EdgeLength& e : edges) groups.join(e.low, e.high);
    std::map<int, std::set<int>> members;
    for (const EdgeLength& e : edges) members[groups.find(e.low)].insert({e.low, e.high});

    int n_merged = 0;
    std::set<int> tried;
    for (const EdgeLength& e : edges) {
      const int g = groups.find(e.low);
      const auto& group = members[g];
      if (tried.insert(g).second) n_merged += try_merge({group.begin(), group.end()});
      if (group.size() > 2) n_merged += try_merge({e.low, e.high});
    }
    if (n_merged > 0) work_.remove(dead_triangle_);
    return n_merged;
  }

 private:
  std::vector<EdgeLength> tiny_edges() const;
  int try_merge(const std::vector<int>& group);
  bool is_small(const std::vector<int>& group) const;
  Vec3 meeting_point(const std::vector<int>& group) const;
  void collect_triangles(const std::vector<int>& group);
  bool is_regular_link(const PhaseSet& phases) const;
  /// Neighbours of the new vertex and the remaining triangles at each, as places in remaining_.
  using Link = std::map<int, std::vector<int>>;
  bool lets_neighbours_be(int dying_triangle, const Link& link) const;
  bool is_conforming(const std::vector<int>& uses, int neighbour) const;
  bool keeps_orientation(const std::vector<int>& group, const Vec3& point) const;

  WorkingMesh& work_;
  FilmMesh& mesh_;
  const RemeshParameters& parameters_;
  std::vector<double> target_;  // at vertices
  std::optional<VertexStars> star_;
  std::vector<char> dead_triangle_, touched_;
  // of the group under examination
  std::vector<int> dying_;  // triangles that lose an edge
  struct Remaining {
    int triangle, corner;  // the corner that moves to the new vertex
  };
  std::vector<Remaining> remaining_;
};

std::vector<EdgeLength> Merger::tiny_edges() const {
  std::vector<EdgeLength> edges = edges_below(mesh_, target_, parameters_.merge_below);
  std::erase_if(edges, [&](const EdgeLength& e) { return work_.held[e.low] || work_.held[e.high]; });
  return edges;
}

int Merger::try_merge(const std::vector<int>& group) {
  if (std::any_of(group.begin(), group.end(), [&](int v) { return touched_[v] != 0; })) return 0;
  if (!is_small(group)) return 0;
  std::vector<Phase> all;
  for (int v : group) all.insert(all.end(), work_.phases[v].begin(), work_.phases[v].end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  if (static_cast<int>(all.size()) > largest_number_of_phases) return 0;
  PhaseSet phases;
  for (Phase p : all) phases.insert(p);

  const Vec3 point = meeting_point(group);
  collect_triangles(group);
  if (!is_regular_link(phases) || !keeps_orientation(group, point)) return 0;

  const int kept = group.front();
  for (int t : dying_) dead_triangle_[t] = 1;
  for (const Remaining& r : remaining_) mesh_.triangle[r.triangle].vertex[r.corner] = kept;
  for (int v : group)
    for (int t : (*star_)[v])
      for (int x : mesh_.triangle[t].vertex) touched_[x] = 1;
  for (int v : group) touched_[v] = 1;
  mesh_.position[kept] = point;
  work_.phases[kept] = phases;
  return static_cast<int>(group.size()) - 1;
}

bool Merger::is_small(const std::vector<int>& group) const {
  if (static_cast<int>(group.size()) > largest_group) return false;
  for (int v : group) {
    const double reach = 0.5 * target_[v];
    if (norm_squared(mesh_.edge(group.front(), v)) > reach * reach) return false;
  }
  return true;
}

Vec3 Merger::meeting_point(const std::vector<int>& group) const {
  VertexKind highest = VertexKind::Film;
  for (int v : group) highest = std::max(highest, work_.kind(v));
  Vec3 sum;
  int n = 0;
  for (int v : group)
    if (work_.kind(v) == highest) {
      sum += mesh_.edge(group.front(), v);
      ++n;
    }
  return mesh_.position[group.front()] + sum / n;
}

/// The triangles of the group: those that lose an edge, and those that go on with one corner moved.
void Merger::collect_triangles(const std::vector<int>& group) {
  std::vector<int> all;
  for (int v : group) all.insert(all.end(), (*star_)[v].begin(), (*star_)[v].end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  dying_.clear();
  remaining_.clear();
  for (int t : all) {
    int n_inside = 0, corner = -1;
    for (int c = 0; c < 3; ++c)
      if (std::binary_search(group.begin(), group.end(), mesh_.triangle[t].vertex[c])) {
        ++n_inside;
        corner = c;
      }
    if (n_inside >= 2)
      dying_.push_back(t);
    else
      remaining_.push_back({t, corner});
  }
}

/// The link of the new vertex: a node for each neighbour, an arc for each remaining triangle.
bool Merger::is_regular_link(const PhaseSet& phases) const {
  Link node;
  std::map<std::pair<int, int>, int> arc;
  PhaseSet present;
  for (int n = 0; n < static_cast<int>(remaining_.size()); ++n) {
    const FilmTriangle& t = mesh_.triangle[remaining_[n].triangle];
    const int x = t.vertex[(remaining_[n].corner + 1) % 3], y = t.vertex[(remaining_[n].corner + 2) % 3];
    if (++arc[std::minmax(x, y)] > 1) return false;
    node[x].push_back(n);
    node[y].push_back(n);
    present.insert(t.phase_a);
    present.insert(t.phase_b);
  }
  if (!(present == phases)) return false;
  if (static_cast<int>(node.size()) - static_cast<int>(arc.size()) + phases.size() != 2) return false;
  UnionFind linked(static_cast<int>(remaining_.size()));
  for (const auto& [x, uses] : node) {
    if (!is_conforming(uses, x)) return false;
    for (int n : uses) linked.join(uses.front(), n);
  }
  std::vector<int> class_of;
  if (linked.number(class_of) != 1) return false;
  return std::all_of(dying_.begin(), dying_.end(), [&](int t) { return lets_neighbours_be(t, node); });
}

/// A neighbour that only dying triangles join to the group must go with them, or it would hang in the air.
bool Merger::lets_neighbours_be(int dying_triangle, const Link& link) const {
  const auto goes = [&](int x) {
    return !work_.is_cut(x) && std::all_of((*star_)[x].begin(), (*star_)[x].end(), [&](int t) {
      return std::binary_search(dying_.begin(), dying_.end(), t);
    });
  };
  const auto is_member = [&](int x) {
    return std::any_of(remaining_.begin(), remaining_.end(),
                       [&](const Remaining& r) { return mesh_.triangle[r.triangle].vertex[r.corner] == x; });
  };
  const auto& v = mesh_.triangle[dying_triangle].vertex;
  return std::all_of(v.begin(), v.end(), [&](int x) { return link.contains(x) || is_member(x) || goes(x); });
}

/// Whether the edge from the new vertex to a neighbour is inside one lamella or on a border.
bool Merger::is_conforming(const std::vector<int>& uses, int neighbour) const {
  std::array<std::pair<Phase, Phase>, 3> pair;
  std::array<bool, 3> outward;
  if (uses.size() != 2 && uses.size() != 3) return false;
  PhaseSet phases;
  for (std::size_t n = 0; n < uses.size(); ++n) {
    const auto& [triangle, corner] = remaining_[uses[n]];
    const FilmTriangle& t = mesh_.triangle[triangle];
    pair[n] = {t.phase_a, t.phase_b};
    outward[n] = t.vertex[(corner + 1) % 3] == neighbour;
    phases.insert(t.phase_a);
    phases.insert(t.phase_b);
  }
  if (uses.size() == 2) return pair[0] == pair[1] && outward[0] != outward[1];
  return phases.size() == 3 && pair[0] != pair[1] && pair[0] != pair[2] && pair[1] != pair[2];
}

bool Merger::keeps_orientation(const std::vector<int>& group, const Vec3& point) const {
  constexpr double sliver = 0.05;  // doubled area over the target squared
  const double h = target_[group.front()];
  for (const auto& [triangle, corner] : remaining_) {
    const auto& v = mesh_.triangle[triangle].vertex;
    const Vec3 before = doubled_area_normal(mesh_, triangle);
    const Vec3 p = mesh_.domain.step(point, mesh_.position[v[(corner + 1) % 3]]),
               q = mesh_.domain.step(point, mesh_.position[v[(corner + 2) % 3]]);
    const Vec3 after = cross(p, q);
    if (norm(before) > sliver * h * h && dot(before, after) <= 0) return false;
  }
  return true;
}

}  // namespace

int merge_tiny_features(WorkingMesh& work, const TargetLength& target, const RemeshParameters& parameters) {
  int n_merged = 0;
  for (int pass = 0; pass < largest_number_of_passes; ++pass) {
    const int n_this_pass = Merger(work, target, parameters).run();
    n_merged += n_this_pass;
    if (n_this_pass == 0) break;
  }
  return n_merged;
}

}  // namespace spume::mesh
