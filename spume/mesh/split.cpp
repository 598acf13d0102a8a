#include "spume/mesh/split.hpp"

#include <algorithm>
#include <tuple>

namespace spume::mesh {
namespace {

struct LongEdge {
  double relative_length;  // over the target there
  int edge;
};

bool may_be_cut(const WorkingMesh& work, const MeshEdge& e) {
  return e.n_uses <= 3 && !(work.is_cut(e.low) && work.is_cut(e.high));
}

std::vector<LongEdge> long_edges(const WorkingMesh& work, const EdgeTable& edges, const TargetLength& target,
                                 double split_above) {
  const FilmMesh& mesh = work.mesh;
  const std::vector<double> target_length = targets_at_vertices(mesh, target);
  std::vector<LongEdge> list;
  for (std::size_t n = 0; n < edges.edge.size(); ++n) {
    const MeshEdge& e = edges.edge[n];
    const double relative_length =
        norm(mesh.edge(e.low, e.high)) / (0.5 * (target_length[e.low] + target_length[e.high]));
    if (relative_length > split_above) list.push_back({relative_length, static_cast<int>(n)});
  }
  std::sort(list.begin(), list.end(), [](const LongEdge& a, const LongEdge& b) {
    return std::tuple(-a.relative_length, a.edge) < std::tuple(-b.relative_length, b.edge);
  });
  return list;
}

int middle_vertex(WorkingMesh& work, const EdgeTable& edges, const MeshEdge& e, const Projection& project) {
  PhaseSet phases;
  for (const EdgeUse& use : edges.uses(e)) {
    const FilmTriangle& t = work.mesh.triangle[use.triangle];
    phases.insert(t.phase_a);
    phases.insert(t.phase_b);
  }
  const Vec3 middle = work.mesh.position[e.low] + 0.5 * work.mesh.edge(e.low, e.high);
  const bool is_held = e.n_uses == 1;
  return work.add_vertex(is_held ? middle : project(middle, phases).value_or(middle), phases, is_held);
}

void cut(FilmMesh& mesh, const EdgeUse& use, int middle) {
  FilmTriangle second = mesh.triangle[use.triangle];
  mesh.triangle[use.triangle].vertex[(use.corner + 1) % 3] = middle;
  second.vertex[use.corner] = middle;
  mesh.triangle.push_back(second);
}

}  // namespace

int split_long_edges(WorkingMesh& work, const TargetLength& target, const Projection& project,
                     double split_above) {
  enum class State : char { Whole, Cut, Waiting };
  const EdgeTable edges = build_edges(work.mesh);
  std::vector<State> state(work.mesh.n_triangles(), State::Whole);
  int n_split = 0;
  for (const LongEdge& candidate : long_edges(work, edges, target, split_above)) {
    const MeshEdge& e = edges.edge[candidate.edge];
    const auto uses = edges.uses(e);
    const auto any_is = [&](State s) {
      return std::ranges::any_of(uses, [&](const EdgeUse& use) { return state[use.triangle] == s; });
    };
    if (any_is(State::Cut)) continue;
    // Halves of a shorter edge would leave the next edge across the triangle as long, and so on without end.
    const bool waits = !may_be_cut(work, e) || any_is(State::Waiting);
    for (const EdgeUse& use : uses) state[use.triangle] = waits ? State::Waiting : State::Cut;
    if (waits) continue;
    const int middle = middle_vertex(work, edges, e, project);
    for (const EdgeUse& use : uses) cut(work.mesh, use, middle);
    ++n_split;
  }
  return n_split;
}

}  // namespace spume::mesh
