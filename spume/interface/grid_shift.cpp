#include "spume/interface/grid_shift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "spume/mesh/measure.hpp"

namespace spume::interface {

namespace {

/// b [h] of films whose squared direction cosine is n², linear between values at 1 − n² = 0, 0.1, … 1.
double shift_amplitude(double squared_cosine) {
  constexpr std::array<double, 11> at{0.00312, 0.00368, 0.00311, 0.00234, 0.00182, 0.00146,
                                      0.00107, 0.00064, 0.00025, 0.00008, 0};
  const double place = 10 * std::clamp(1 - squared_cosine, 0.0, 1.0);
  const int n = std::min(static_cast<int>(place), 9);
  return at[n] + (place - n) * (at[n + 1] - at[n]);
}

}  // namespace

void undo_grid_shift(const grid::Grid& grid, const mesh::Topology& topology, mesh::FilmMesh& films) {
  const double h = grid.h();
  const std::vector<Vec3> normal = mesh::doubled_vertex_normals(films);
  for (int v = 0; v < films.n_vertices(); ++v) {
    if (topology.vertex_kind[v] != mesh::VertexKind::Film) continue;
    const Vec3 n = normalized(normal[v]),
               place = (2 * std::numbers::pi / h) * (films.position[v] - grid.box().lower);
    double shift = 0;
    for (int d = 0; d < 3; ++d)
      shift += std::copysign(shift_amplitude(n[d] * n[d]), n[d]) * std::sin(place[d]);
    films.position[v] -= h * shift * n;
  }
}

}  // namespace spume::interface
