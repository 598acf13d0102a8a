#include "spume/meshing/rim_widths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spume::meshing {

namespace {

constexpr double least_detour = 2.5;  // along the rim over straight across

/// A place on a border: the distance from its first vertex [m].
struct Place {
  int border;
  double arc;
};

class Rims {
 public:
  Rims(const mesh::FilmMesh& films, const mesh::Topology& topology)
      : films_(films),
        topology_(topology),
        arc_(arc_lengths(films, topology)),
        borders_of_(topology.n_lamellae()),
        lamellae_of_(topology.n_borders()) {
    for (const mesh::BorderEdge& edge : topology.border_edge) {
      auto& lamellae = lamellae_of_[edge.border];
      if (!lamellae.empty()) continue;
      for (int t : edge.triangle) lamellae.push_back(topology.triangle_lamella[t]);
    }
    for (int b = 0; b < topology.n_borders(); ++b)
      for (int lamella : lamellae_of_[b]) borders_of_[lamella].push_back(b);
  }

  double width_at(int border, int n, double largest) const {
    double width = largest;
    for (int lamella : lamellae_of_[border])
      for (int other : borders_of_[lamella]) search(border, n, other, width);
    return width;
  }

 private:
  void search(int border, int n, int other, double& width) const {
    const auto& line = topology_.border[other].vertices;
    const int v = topology_.border[border].vertices[n];
    for (std::size_t k = 1; k < line.size(); ++k) {
      const Vec3 to_start = films_.edge(v, line[k - 1]), along = films_.edge(line[k - 1], line[k]);
      const double length_squared = norm_squared(along);
      const double part =
          length_squared > 0 ? std::clamp(-dot(to_start, along) / length_squared, 0.0, 1.0) : 0.0;
      const double distance = norm(to_start + part * along);
      if (!(distance < width)) continue;
      const double arc = arc_[other][k - 1] + part * (arc_[other][k] - arc_[other][k - 1]);
      if (along_rim({border, arc_[border][n]}, {other, arc}) > least_detour * distance) width = distance;
    }
  }

  /// The way along the rim between places on the same border or on two that share an end; longer ways count
  /// as infinite.
  double along_rim(const Place& a, const Place& b) const {
    const auto& line_a = topology_.border[a.border];
    const auto& line_b = topology_.border[b.border];
    const double length_a = arc_[a.border].back(), length_b = arc_[b.border].back();
    double shortest = std::numeric_limits<double>::infinity();
    if (a.border == b.border) {
      shortest = std::abs(a.arc - b.arc);
      if (line_a.closed) shortest = std::min(shortest, length_a - shortest);
      return shortest;
    }
    if (line_a.closed || line_b.closed) return shortest;
    for (const bool front_a : {true, false})
      for (const bool front_b : {true, false}) {
        if ((front_a ? line_a.vertices.front() : line_a.vertices.back()) !=
            (front_b ? line_b.vertices.front() : line_b.vertices.back()))
          continue;
        shortest =
            std::min(shortest, (front_a ? a.arc : length_a - a.arc) + (front_b ? b.arc : length_b - b.arc));
      }
    return shortest;
  }

  const mesh::FilmMesh& films_;
  const mesh::Topology& topology_;
  std::vector<std::vector<double>> arc_;
  std::vector<std::vector<int>> borders_of_, lamellae_of_;
};

}  // namespace

std::vector<std::vector<double>> arc_lengths(const mesh::FilmMesh& films, const mesh::Topology& topology) {
  std::vector<std::vector<double>> arc(topology.n_borders());
  for (int b = 0; b < topology.n_borders(); ++b) {
    const auto& line = topology.border[b].vertices;
    arc[b].assign(1, 0.0);
    for (std::size_t n = 1; n < line.size(); ++n)
      arc[b].push_back(arc[b].back() + norm(films.edge(line[n - 1], line[n])));
  }
  return arc;
}

std::vector<std::vector<double>> rim_widths(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                            double largest) {
  const Rims rims(films, topology);
  std::vector<std::vector<double>> width(topology.n_borders());
  for (int b = 0; b < topology.n_borders(); ++b)
    for (int n = 0; n < static_cast<int>(topology.border[b].vertices.size()); ++n)
      width[b].push_back(rims.width_at(b, n, largest));
  return width;
}

}  // namespace spume::meshing
