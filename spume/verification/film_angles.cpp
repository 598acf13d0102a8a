#include "spume/verification/film_angles.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

namespace spume::verification {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Sums up deviations.
struct Deviations {
  double squares = 0, largest = 0;
  int count = 0;

  void add(double deviation) {
    squares += deviation * deviation;
    largest = std::max(largest, std::abs(deviation));
    ++count;
  }
  /// Not numbers where nothing was measured, so that no band is met by it.
  double rms() const { return std::sqrt(squares / count); }
  double worst() const { return count > 0 ? largest : std::numeric_limits<double>::quiet_NaN(); }
};

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) / degree;
}

/// Vertices of each lamella that lie inside the film.
std::vector<std::vector<int>> inner_vertices(const mesh::Topology& topology) {
  std::vector<std::vector<int>> vertices(topology.n_lamellae());
  for (const auto& dof : topology.film_dof)
    if (topology.vertex_kind[dof.vertex] == mesh::VertexKind::Film)
      vertices[dof.lamella].push_back(dof.vertex);
  return vertices;
}

/// The direction in the film at right angles to the border, away from it; by a quadric w = a + bu + cv + du²
/// + euv + fv² over the plane through the border's tangent and the mean of the film's vertices.
std::optional<Vec3> film_direction(const mesh::FilmMesh& films, const std::vector<int>& candidates,
                                   const Vec3& x, const Vec3& tangent, double reach) {
  std::vector<Vec3> near;
  Vec3 mean;
  for (int v : candidates)
    if (const Vec3 d = films.position[v] - x; norm(d) < reach) {
      near.push_back(d);
      mean += d;
    }
  constexpr std::size_t fewest = 9;
  if (near.size() < fewest) return {};
  const Vec3 out = normalized(mean - dot(mean, tangent) * tangent);
  const Vec3 up = cross(tangent, out);
  const auto n = static_cast<Eigen::Index>(near.size());
  Eigen::MatrixXd matrix(n, 6);
  Eigen::VectorXd height(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double u = dot(near[i], out) / reach, v = dot(near[i], tangent) / reach;
    matrix.row(i) << 1, u, v, u * u, u * v, v * v;
    height(i) = dot(near[i], up) / reach;
  }
  const Eigen::VectorXd c = matrix.colPivHouseholderQr().solve(height);
  // The plane of the film at x, cut by the plane across the border.
  const Vec3 normal = up - c(1) * out - c(2) * tangent;
  Vec3 direction = normalized(cross(normal, tangent));
  return dot(direction, out) > 0 ? direction : -direction;
}

/// Tangent of a border at its end x: the parabola x + as + bs² in the distance s from x that fits its
/// vertices best.
std::optional<Vec3> border_direction(const mesh::FilmMesh& films, const std::vector<int>& line,
                                     bool from_front, double reach) {
  const int n_line = static_cast<int>(line.size());
  const auto at = [&](int n) { return films.position[line[from_front ? n : n_line - 1 - n]]; };
  std::vector<Vec3> place;
  for (int n = 1; n < n_line && norm(at(n) - at(0)) < reach; ++n) place.push_back(at(n) - at(0));
  constexpr std::size_t fewest = 3;
  if (place.size() < fewest) return {};
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(place.size()), 2), right(matrix.rows(), 3);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const double s = norm(place[i]) / reach;
    matrix.row(i) << s, s * s;
    right.row(i) << place[i].x, place[i].y, place[i].z;
  }
  const Eigen::MatrixXd c = matrix.colPivHouseholderQr().solve(right);
  return normalized(Vec3{c(0, 0), c(0, 1), c(0, 2)});
}

void add_film_angles(const mesh::FilmMesh& films, const mesh::Topology& topology, double reach, double edge,
                     Deviations& deviations) {
  const auto inner = inner_vertices(topology);
  std::vector<std::set<int>> lamellae(films.n_vertices());
  for (int t = 0; t < films.n_triangles(); ++t)
    for (int v : films.triangle[t].vertex) lamellae[v].insert(topology.triangle_lamella[t]);
  for (const auto& border : topology.border) {
    const auto& line = border.vertices;
    const int n = static_cast<int>(line.size());
    for (int i = border.closed ? 0 : 1; i < n - 1; ++i) {
      const Vec3 x = films.position[line[i]];
      const bool near_junction = std::any_of(topology.junction.begin(), topology.junction.end(),
                                             [&](int j) { return norm(films.position[j] - x) < 1.5 * edge; });
      if (near_junction || lamellae[line[i]].size() != 3) continue;
      const int before = i == 0 ? line[n - 2] : line[i - 1];
      const Vec3 tangent = normalized(films.position[line[i + 1]] - films.position[before]);
      std::vector<Vec3> directions;
      for (int lamella : lamellae[line[i]])
        if (const auto d = film_direction(films, inner[lamella], x, tangent, reach)) directions.push_back(*d);
      if (directions.size() != 3) continue;
      for (int a = 0; a < 3; ++a) deviations.add(angle_between(directions[a], directions[(a + 1) % 3]) - 120);
    }
  }
}

void add_border_angles(const mesh::FilmMesh& films, const mesh::Topology& topology, double reach,
                       Deviations& deviations) {
  const double right_angle = std::acos(-1.0 / 3) / degree;
  for (int junction : topology.junction) {
    std::vector<Vec3> directions;
    for (const auto& border : topology.border)
      for (const bool front : {true, false})
        if ((front ? border.vertices.front() : border.vertices.back()) == junction)
          if (const auto d = border_direction(films, border.vertices, front, reach)) directions.push_back(*d);
    for (std::size_t a = 0; a < directions.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        deviations.add(angle_between(directions[a], directions[b]) - right_angle);
  }
}

}  // namespace

PlateauAngles plateau_angles(const mesh::FilmMesh& films, const mesh::Topology& topology, double reach,
                             double edge) {
  Deviations film, border;
  add_film_angles(films, topology, reach, edge, film);
  add_border_angles(films, topology, 1.5 * reach, border);
  return {.film_rms = film.rms(),
          .film_largest = film.worst(),
          .border_rms = border.rms(),
          .border_largest = border.worst(),
          .n_film_angles = film.count,
          .n_border_angles = border.count};
}

}  // namespace spume::verification
