#include "spume/interface/lost_bubbles.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "spume/base/error.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::interface {

namespace {

mesh::Phase closest_neighbour(const mesh::FilmMesh& films, mesh::Phase bubble, int n_phases) {
  std::vector<double> shared(n_phases, 0.0);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto& triangle = films.triangle[t];
    if (triangle.phase_a == bubble) shared[triangle.phase_b] += mesh::triangle_area(films, t);
    if (triangle.phase_b == bubble) shared[triangle.phase_a] += mesh::triangle_area(films, t);
  }
  mesh::Phase best = 0;
  for (int p = 1; p < n_phases; ++p)
    if (shared[p] > shared[best]) best = p;
  return best;
}

}  // namespace

void remove_bubble(mesh::FilmMesh& films, state::Phases& phases, mesh::Phase bubble,
                   std::vector<PhaseChange>& changes) {
  const mesh::Phase heir = closest_neighbour(films, bubble, phases.count());
  std::vector<mesh::FilmTriangle> kept;
  kept.reserve(films.triangle.size());
  for (const auto& t : films.triangle) {
    const mesh::Phase a = t.phase_a == bubble ? heir : t.phase_a, b = t.phase_b == bubble ? heir : t.phase_b;
    if (a != b) kept.push_back(mesh::make_triangle(t.vertex[0], t.vertex[1], t.vertex[2], a, b));
  }
  films.triangle = std::move(kept);
  mesh::drop_unused_vertices(films);
  const double gas = std::exchange(phases.target_volume[bubble], 0.0);
  if (heir != 0) phases.target_volume[heir] += gas;
  if (bubble == phases.above_membrane) phases.above_membrane = 0;
  changes.push_back({PhaseChange::Kind::Lost, bubble, heir, gas});
}

namespace {

/// What films enclose is not known for a bubble that goes through a periodic box in all directions, and is
/// minus what others have for one that is around them.
void require_bounded(mesh::Phase p, double volume, double smallest_volume) {
  if (volume > -smallest_volume) return;
  throw NumericalError(
      fmt::format("bubble {} goes through the periodic box in all directions and meets its own image; films "
                  "cannot bound it: take a larger box, or end the run before it has grown so far "
                  "(cycle.max_ruptures)",
                  p));
}

}  // namespace

void remove_small_bubbles(mesh::FilmMesh& films, state::Phases& phases, double smallest_volume,
                          std::vector<PhaseChange>& changes) {
  std::vector<double> measured = mesh::phase_volumes(films, phases.count());
  for (mesh::Phase p = 1; p < phases.count(); ++p) {
    if (!phases.alive(p)) continue;
    require_bounded(p, measured[p], smallest_volume);
    if (phases.target_volume[p] >= smallest_volume && measured[p] >= smallest_volume) continue;
    remove_bubble(films, phases, p, changes);
    measured = mesh::phase_volumes(films, phases.count());  // with what the heir gained
  }
}

}  // namespace spume::interface
