#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "spume/mesh/measure.hpp"
#include "spume/meshing/mesh_films.hpp"

namespace spume::meshing {

namespace {

/// The film dofs next to each film dof along the edges of its lamella, increasing, each once.
struct DofGraph {
  std::vector<int> offset, neighbour;

  explicit DofGraph(const mesh::Topology& topology) {
    std::vector<std::pair<int, int>> links;
    links.reserve(6 * topology.corner_dof.size());
    for (const auto& dof : topology.corner_dof)
      for (int c = 0; c < 3; ++c) {
        links.emplace_back(dof[c], dof[(c + 1) % 3]);
        links.emplace_back(dof[(c + 1) % 3], dof[c]);
      }
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
    offset.assign(topology.film_dof.size() + 1, 0);
    for (const auto& [from, to] : links) {
      ++offset[from + 1];
      neighbour.push_back(to);
    }
    for (std::size_t d = 1; d < offset.size(); ++d) offset[d] += offset[d - 1];
  }
};

/// Collects the rings around a dof: two of them, more until there are enough points.
class Rings {
 public:
  Rings(const DofGraph& graph, std::size_t n_dofs) : graph_(graph), seen_by_(n_dofs, -1) {}

  /// The dofs of the rings without the centre.
  const std::vector<int>& around(int centre, std::size_t enough) {
    constexpr int most_rings = 4;
    ring_.assign(1, centre);
    seen_by_[centre] = centre;
    std::size_t first = 0;
    for (int n = 0; n < most_rings && (n < 2 || ring_.size() <= enough); ++n) {
      const std::size_t last = ring_.size();
      for (std::size_t r = first; r < last; ++r)
        for (int s = graph_.offset[ring_[r]]; s < graph_.offset[ring_[r] + 1]; ++s) {
          const int d = graph_.neighbour[s];
          if (std::exchange(seen_by_[d], centre) != centre) ring_.push_back(d);
        }
      first = last;
    }
    ring_.erase(ring_.begin());
    return ring_;
  }

 private:
  const DofGraph& graph_;
  std::vector<int> seen_by_, ring_;
};

/// Coefficients a, b, c, d, e of z = a x + b y + ½(c x² + 2 d x y + e y²) through the origin.
using Quadric = Eigen::Matrix<double, 5, 1>;

/// Least squares with weights 1/r⁴: heights grow as r², so each point counts alike relative to its height,
/// and the outer ring biases the curvature less. Lengths are in units of `scale`. A slight pull to zero
/// selects (nearly) the smallest solution where the points do not determine one (a very narrow film).
Quadric fit_quadric(const mesh::FilmMesh& films, const mesh::Topology& topology, int centre,
                    const Vec3& normal, const std::vector<int>& points, double scale) {
  const Vec3 axis = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = normalized(cross(normal, axis)), v = cross(normal, u);
  Eigen::Matrix<double, 5, 5> matrix = Eigen::Matrix<double, 5, 5>::Zero();
  Quadric right = Quadric::Zero();
  for (int point : points) {
    const Vec3 r = films.edge(topology.film_dof[centre].vertex, topology.film_dof[point].vertex) / scale;
    const double x = dot(r, u), y = dot(r, v), z = dot(r, normal);
    if (norm_squared(r) == 0) continue;
    const double weight = 1 / (norm_squared(r) * norm_squared(r));
    const Quadric row{x, y, 0.5 * x * x, x * y, 0.5 * y * y};
    matrix += weight * row * row.transpose();
    right += weight * z * row;
  }
  matrix.diagonal().array() += 1e-9 * matrix.trace();
  return matrix.ldlt().solve(right);
}

/// k₁² + k₂² at the origin, by the shape operator S = I⁻¹ II: tr(S²) = (tr S)² − 2 det S.
double squared_curvatures(const Quadric& q) {
  const double a = q(0), b = q(1), c = q(2), d = q(3), e = q(4);
  const double g = 1 + a * a + b * b;  // det I
  const double trace = ((1 + b * b) * c - 2 * a * b * d + (1 + a * a) * e) / (g * std::sqrt(g));
  const double determinant = (c * e - d * d) / (g * g);
  return std::max(0.0, trace * trace - 2 * determinant);
}

/// Area-weighted mean of each value and those next to it along its lamella.
std::vector<double> smooth_once(const DofGraph& graph, const std::vector<double>& area,
                                const std::vector<double>& value) {
  std::vector<double> result = value;
  for (std::size_t d = 0; d < value.size(); ++d) {
    double sum = area[d] * value[d], weight = area[d];
    for (int s = graph.offset[d]; s < graph.offset[d + 1]; ++s) {
      sum += area[graph.neighbour[s]] * value[graph.neighbour[s]];
      weight += area[graph.neighbour[s]];
    }
    if (weight > 0) result[d] = sum / weight;
  }
  return result;
}

}  // namespace

std::vector<double> curvature_squared(const mesh::FilmMesh& films, const mesh::Topology& topology) {
  const DofGraph graph(topology);
  const std::size_t n = topology.film_dof.size();
  Rings rings(graph, n);
  const std::vector<Vec3> normal = mesh::film_dof_normals(films, topology);
  std::vector<double> curvature(n, 0);
  for (std::size_t d = 0; d < n; ++d) {
    const auto& dof = topology.film_dof[d];
    // At a border the film is on one side only, and two rings of it determine a quadric badly.
    const bool inside = topology.vertex_kind[dof.vertex] == mesh::VertexKind::Film;
    const std::vector<int>& points = rings.around(static_cast<int>(d), inside ? 8 : 14);
    double mean_square = 0;
    for (int p : points) mean_square += norm_squared(films.edge(dof.vertex, topology.film_dof[p].vertex));
    if (!(mean_square > 0)) continue;
    const double scale = std::sqrt(mean_square / static_cast<double>(points.size()));
    const Quadric quadric = fit_quadric(films, topology, static_cast<int>(d), normal[d], points, scale);
    curvature[d] = squared_curvatures(quadric) / (scale * scale);
  }
  return smooth_once(graph, mesh::film_dof_areas(films, topology), curvature);
}

}  // namespace spume::meshing
