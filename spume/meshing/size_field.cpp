#include "spume/meshing/size_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/meshing/rim_widths.hpp"

namespace spume::meshing {

SizeField::SizeField(const mesh::FilmMesh& films, const mesh::Topology& topology, const Sizes& sizes)
    : domain_(films.domain), sizes_(sizes) {
  expects(sizes.smallest > 0 && sizes.at_junctions <= sizes.at_borders &&
              sizes.at_borders <= sizes.in_films && sizes.at_junctions > 0 && sizes.grading > 0,
          "sizes of a mesh are positive, and grow from junctions to borders to films");
  // The smallest target there can be decides how far a point is felt.
  const double finest = std::min(sizes.at_junctions, sizes.smallest);
  reach_ = std::max((sizes.in_films - finest) / sizes.grading, sizes.in_films);
  const auto arc = arc_lengths(films, topology);
  const auto width = rim_widths(films, topology, sizes.at_borders);
  const auto bounded = [&](double size) {
    return std::max(size, std::min(sizes.smallest, sizes.at_borders));
  };
  for (int b = 0; b < topology.n_borders(); ++b) {
    const auto& border = topology.border[b];
    double previous = 0;
    for (std::size_t n = 0; n < border.vertices.size(); ++n) {
      double size = width[b][n];
      if (!border.closed) size = std::min(size, arc[b].back());
      size = bounded(size);
      if (!border.closed && (n == 0 || n + 1 == border.vertices.size()))
        size = std::min(size, sizes.at_junctions);
      const Vec3& x = films.position[border.vertices[n]];
      add(x, size);
      // Border vertices may be farther apart than the targets between them ask for.
      if (n > 0) {
        const Vec3 back = films.edge(border.vertices[n], border.vertices[n - 1]);
        const int n_parts = static_cast<int>(std::min(8.0, norm(back) / (0.5 * std::min(size, previous))));
        for (int part = 1; part < n_parts; ++part) {
          const double weight = static_cast<double>(part) / n_parts;
          add(x + weight * back, (1 - weight) * size + weight * previous);
        }
      }
      previous = size;
    }
  }
  if (!points_.empty()) build_tree(0, static_cast<int>(points_.size()));
}

void SizeField::add(const Vec3& x, double size) {
  points_.push_back({domain_.inside(x), std::min(size, sizes_.at_borders)});
}

/// The tree of points [first, last), halved across its longest extent down to a few points; gives its root.
int SizeField::build_tree(int first, int last) {
  constexpr int few = 8;
  const int root = static_cast<int>(nodes_.size());
  Node node{first, last, 0, points_[first].position, points_[first].position, points_[first].size};
  for (int n = first; n < last; ++n) {
    const Point& p = points_[n];
    for (int d = 0; d < 3; ++d) {
      node.low[d] = std::min(node.low[d], p.position[d]);
      node.high[d] = std::max(node.high[d], p.position[d]);
    }
    node.least = std::min(node.least, p.size);
  }
  nodes_.push_back(node);
  if (last - first <= few) return root;
  const Vec3 extent = node.high - node.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const int middle = (first + last) / 2;
  std::nth_element(points_.begin() + first, points_.begin() + middle, points_.begin() + last,
                   [axis](const Point& a, const Point& b) { return a.position[axis] < b.position[axis]; });
  build_tree(first, middle);
  nodes_[root].right = build_tree(middle, last);
  return root;
}

double SizeField::operator()(const Vec3& x) const {
  double size = sizes_.in_films;
  if (!nodes_.empty()) domain_.for_each_image(x, reach_, [&](const Vec3& image) { search(image, size); });
  return size;
}

void SizeField::search(const Vec3& x, double& size) const {
  constexpr int most_waiting = 64;                           // more than a tree of halves is deep
  std::array<std::pair<int, double>, most_waiting> waiting;  // nodes, and how far they are, squared
  const auto distance_squared = [&](int n) {
    const Node& node = nodes_[n];
    double sum = 0;
    for (int d = 0; d < 3; ++d) {
      const double outside = std::max({node.low[d] - x[d], x[d] - node.high[d], 0.0});
      sum += outside * outside;
    }
    return sum;
  };
  int n_waiting = 0;
  waiting[n_waiting++] = {0, distance_squared(0)};
  while (n_waiting > 0) {
    const auto [n, away_squared] = waiting[--n_waiting];
    const Node& node = nodes_[n];
    const double node_room = (size - node.least) / sizes_.grading;  // nearer than this it counts
    if (node_room <= 0 || away_squared >= node_room * node_room) continue;
    if (node.right > 0) {
      const std::pair left{n + 1, distance_squared(n + 1)}, right{node.right, distance_squared(node.right)};
      const bool left_first = left.second <= right.second;
      waiting[n_waiting++] = left_first ? right : left;
      waiting[n_waiting++] = left_first ? left : right;
      continue;
    }
    for (int k = node.first; k < node.last; ++k) {
      const Point& p = points_[k];
      const double room = (size - p.size) / sizes_.grading, apart_squared = norm_squared(p.position - x);
      if (room > 0 && apart_squared < room * room) size = p.size + sizes_.grading * std::sqrt(apart_squared);
    }
  }
}

}  // namespace spume::meshing
