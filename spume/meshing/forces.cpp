#include "spume/meshing/forces.hpp"

#include <algorithm>
#include <cmath>

namespace spume::meshing {

namespace {

/// Each edge of a film vertex is met twice, once from either triangle, which changes no mean.
Vec3 springs(const StarMesh& m, std::span<const double> target, int v) {
  constexpr double longer = 1.2, relaxation = 0.2;
  double lengths = 0, sizes = 0;
  const auto for_each_edge = [&](auto&& body) {
    for (int t : m.star[v])
      for (int w : m.films.triangle[t].vertex)
        if (w != v) body(m.films.edge(w, v), 0.5 * (target[v] + target[w]));
  };
  for_each_edge([&](const Vec3& edge, double size) {
    lengths += norm_squared(edge);
    sizes += size * size;
  });
  const double scale = longer * std::sqrt(lengths / sizes);
  Vec3 force;
  for_each_edge([&](const Vec3& edge, double size) {
    const double length = norm(edge), rest = scale * size;
    if (length < rest && length > 0) force += (rest / length - 1) * edge;
  });
  return (0.5 * relaxation) * force;
}

Vec3 centroid_pull(const StarMesh& m, std::span<const double> target, int v) {
  constexpr double relaxation = 0.7;
  Vec3 sum;
  double weights = 0;
  for (int t : m.star[v]) {
    const auto& corner = m.films.triangle[t].vertex;
    const double size = (target[corner[0]] + target[corner[1]] + target[corner[2]]) / 3;
    const double weight = mesh::triangle_area(m.films, t) / (size * size * size);
    Vec3 centroid;
    for (int w : corner) centroid += m.films.edge(v, w) / 3.0;
    sum += weight * centroid;
    weights += weight;
  }
  return weights > 0 ? (relaxation / weights) * sum : Vec3{};
}

Vec3 border_springs(const StarMesh& m, std::span<const double> target, int v) {
  constexpr double relaxation = 0.5;
  std::array<int, 2> end{-1, -1};
  for (int t : m.star[v])
    for (int w : m.films.triangle[t].vertex) {
      if (w == v || w == end[0] || w == end[1] || !m.is_border_edge(v, w)) continue;
      if (end[0] < 0)
        end[0] = w;
      else
        end[1] = w;
    }
  if (end[1] < 0) return {};
  const Vec3 back = m.films.edge(v, end[0]), on = m.films.edge(v, end[1]);
  const double size_back = 0.5 * (target[v] + target[end[0]]), size_on = 0.5 * (target[v] + target[end[1]]);
  // The place x along the line where |x − back| / size_back = |on − x| / size_on.
  const double shift = (norm(on) * size_back - norm(back) * size_on) / (size_back + size_on);
  return (relaxation * shift) * normalized(shift > 0 ? on : -back);
}

}  // namespace

Vec3 wanted_displacement(const StarMesh& m, std::span<const double> target, int v) {
  if (m.work.held[v] || m.star[v].empty()) return {};
  switch (m.work.kind(v)) {
    case mesh::VertexKind::Film:
      return m.is_near_border(v) ? centroid_pull(m, target, v) : springs(m, target, v);
    case mesh::VertexKind::Border:
      return border_springs(m, target, v);
    case mesh::VertexKind::Junction:
      break;
  }
  return {};
}

}  // namespace spume::meshing
