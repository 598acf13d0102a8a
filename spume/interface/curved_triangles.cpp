#include "spume/interface/curved_triangles.hpp"

#include <algorithm>
#include <utility>

#include "spume/mesh/measure.hpp"

namespace spume::interface {

namespace {

constexpr double largest_sagitta = 0.15;  // of the length of the edge

Vec3 midpoint(const Vec3& a, const Vec3& b, Vec3 displacement) {
  const double size = norm(displacement), limit = largest_sagitta * norm(b - a);
  if (size > limit) displacement *= limit / size;
  return 0.5 * (a + b) + displacement;
}

Vec3 film_edge_midpoint(const Vec3& a, const Vec3& b, const Vec3& normal_a, const Vec3& normal_b) {
  const Vec3 sum = normal_a + normal_b;
  const double size = norm(sum);
  // Normals more than 120 degrees apart do not describe a smooth film.
  if (size <= 1) return 0.5 * (a + b);
  return midpoint(a, b, dot(normal_b - normal_a, b - a) / (8 * size) * sum);
}

/// Unit tangent of a border at `here`, towards `next`, second order on uneven spacing.
Vec3 tangent(const Vec3& previous, const Vec3& here, const Vec3& next) {
  const Vec3 forward = next - here, backward = here - previous;
  const double f = norm(forward), b = norm(backward);
  if (!(f > 0) || !(b > 0)) return normalized(forward);
  return normalized(b / (f * (f + b)) * forward + f / (b * (f + b)) * backward);
}

/// Unit tangents at all points of a border, in its direction.
std::vector<Vec3> border_tangents(const mesh::FilmMesh& films, const mesh::PlateauBorder& border) {
  const auto& line = border.vertices;
  const int n = static_cast<int>(line.size());
  // Unrolled from the start of the border.
  std::vector<Vec3> point{films.position[line[0]]};
  for (int m = 1; m < n; ++m) point.push_back(films.domain.near(films.position[line[m]], point.back()));
  std::vector<Vec3> tangents(n);
  for (int m = 1; m + 1 < n; ++m) tangents[m] = tangent(point[m - 1], point[m], point[m + 1]);
  if (border.closed && n > 3) {
    tangents.front() = tangents.back() =
        tangent(point[n - 2], point[n - 1], point[n - 1] + (point[1] - point[0]));
  } else {
    tangents.front() = normalized(point[1] - point[0]);
    tangents.back() = normalized(point[n - 1] - point[n - 2]);
  }
  return tangents;
}

void set_midpoint(const mesh::FilmMesh& films, const mesh::BorderEdge& edge, const Vec3& point,
                  std::vector<EdgeMidpoints>& midpoints) {
  for (int t : edge.triangle)
    for (int e = 0; e < 3; ++e) {
      const int a = films.triangle[t].vertex[e], b = films.triangle[t].vertex[(e + 1) % 3];
      if ((a == edge.vertex[0] && b == edge.vertex[1]) || (a == edge.vertex[1] && b == edge.vertex[0]))
        midpoints[t][e] = films.domain.near(point, films.corners(t)[e]);
    }
}

}  // namespace

std::vector<EdgeMidpoints> edge_midpoints(const mesh::FilmMesh& films, const mesh::Topology& topology) {
  std::vector<EdgeMidpoints> midpoints(films.triangle.size());
  const std::vector<Vec3> normal = mesh::film_dof_normals(films, topology);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto corner = films.corners(t);
    const auto& dof = topology.corner_dof[t];
    for (int e = 0; e < 3; ++e) {
      const int f = (e + 1) % 3;
      midpoints[t][e] = film_edge_midpoint(corner[e], corner[f], normal[dof[e]], normal[dof[f]]);
    }
  }

  std::vector<std::vector<Vec3>> tangents;
  for (const auto& border : topology.border) tangents.push_back(border_tangents(films, border));
  std::vector<std::vector<int>> edges_of_border(topology.border.size());
  for (std::size_t e = 0; e < topology.border_edge.size(); ++e)
    edges_of_border[topology.border_edge[e].border].push_back(static_cast<int>(e));
  for (std::size_t b = 0; b < topology.border.size(); ++b) {
    const auto& line = topology.border[b].vertices;
    // Place along the border of each of its edges, by their ends.
    std::vector<std::pair<std::pair<int, int>, int>> place;
    for (int m = 0; m + 1 < static_cast<int>(line.size()); ++m)
      place.push_back({std::minmax(line[m], line[m + 1]), m});
    std::sort(place.begin(), place.end());
    for (int e : edges_of_border[b]) {
      const auto& edge = topology.border_edge[e];
      const std::pair<std::pair<int, int>, int> key{{edge.vertex[0], edge.vertex[1]}, 0};
      const auto found = std::lower_bound(place.begin(), place.end(), key);
      const Vec3 p = films.position[edge.vertex[0]], q = p + films.edge(edge.vertex[0], edge.vertex[1]);
      Vec3 displacement;
      if (found != place.end() && found->first == key.first) {
        const int m = found->second;
        displacement = norm(q - p) / 8 * (tangents[b][m] - tangents[b][m + 1]);
      }
      set_midpoint(films, edge, midpoint(p, q, displacement), midpoints);
    }
  }
  return midpoints;
}

}  // namespace spume::interface
