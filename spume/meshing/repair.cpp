#include "spume/meshing/repair.hpp"

#include <algorithm>
#include <utility>

#include "spume/meshing/local_changes.hpp"

namespace spume::meshing {

namespace {

constexpr int most_passes = 8;

/// Triangles worse than `limit`, the worst first.
std::vector<std::pair<double, int>> bad_triangles(const StarMesh& m, double limit) {
  std::vector<std::pair<double, int>> list;
  for (int t = 0; t < m.films.n_triangles(); ++t) {
    if (m.dead[t]) continue;
    const double bad = m.badness_of(t);
    if (bad > limit) list.emplace_back(-bad, t);
  }
  std::sort(list.begin(), list.end());
  return list;
}

bool flip_some_edge(LocalChanges& change, int t) {
  for (int c = 0; c < 3; ++c)
    if (change.flip_if_better(t, c)) return true;
  return false;
}

bool move_some_vertex(LocalChanges& change, const StarMesh& m, int t) {
  bool moved = false;
  const auto corner = m.films.triangle[t].vertex;
  for (int v : corner) moved = change.relocate(v) || moved;
  return moved;
}

bool collapse_some_edge(LocalChanges& change, const StarMesh& m, int t) {
  const auto corner = m.films.triangle[t].vertex;
  for (int c = 0; c < 3; ++c)
    for (const bool forward : {true, false}) {
      const int v = corner[forward ? c : (c + 1) % 3], w = corner[forward ? (c + 1) % 3 : c];
      if (change.collapse_if_better(v, w)) return true;
    }
  return false;
}

bool absorb_some_vertex(LocalChanges& change, int t) {
  for (int c = 0; c < 3; ++c)
    if (change.absorb_if_better(t, c)) return true;
  return false;
}

}  // namespace

RepairReport repair(StarMesh& m, const mesh::Projection& project, std::span<const double> target,
                    double wanted_degrees) {
  RepairReport report;
  const double limit = badness_of_angle(wanted_degrees);
  LocalChanges change(m, project, target);
  for (int pass = 0; pass < most_passes; ++pass) {
    const auto list = bad_triangles(m, limit);
    report.n_left = static_cast<int>(list.size());
    bool changed = false;
    for (const auto& [negative, t] : list) {
      if (m.dead[t] || m.badness_of(t) <= limit) continue;
      int* count = nullptr;
      if (flip_some_edge(change, t))
        count = &report.n_flipped;
      else if (move_some_vertex(change, m, t))
        count = &report.n_moved;
      else if (collapse_some_edge(change, m, t))
        count = &report.n_collapsed;
      else if (absorb_some_vertex(change, t))
        count = &report.n_absorbed;
      if (!count) continue;
      ++*count;
      changed = true;
    }
    if (!changed) break;
  }
  return report;
}

int fill_corners(StarMesh& m, const mesh::Projection& project) {
  LocalChanges change(m, project, {});
  int n_flipped = 0;
  for (int t = 0; t < m.films.n_triangles(); ++t)
    for (int c = 0; c < 3 && !m.dead[t]; ++c) n_flipped += change.fill_corner(t, c);
  return n_flipped;
}

}  // namespace spume::meshing
