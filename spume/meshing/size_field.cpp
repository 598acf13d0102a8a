#include "spume/meshing/size_field.hpp"

#include <algorithm>
#include <cmath>

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
  sort_points();
}

void SizeField::add(const Vec3& x, double size) {
  const Vec3 inside = domain_.inside(x);
  points_.push_back({bin_of(inside), inside, std::min(size, sizes_.at_borders)});
}

void SizeField::sort_points() {
  std::sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.bin < b.bin; });
}

SizeField::Bin SizeField::bin_of(const Vec3& x) const {
  return {static_cast<int>(std::floor(x.x / reach_)), static_cast<int>(std::floor(x.y / reach_)),
          static_cast<int>(std::floor(x.z / reach_))};
}

double SizeField::operator()(const Vec3& x) const {
  double size = sizes_.in_films;
  domain_.for_each_image(x, reach_, [&](const Vec3& image) { search(image, size); });
  return size;
}

void SizeField::search(const Vec3& x, double& size) const {
  const Bin centre = bin_of(x);
  for (int di = -1; di <= 1; ++di)
    for (int dj = -1; dj <= 1; ++dj) {
      // The three bins along the last axis lie together in the order of bins.
      const Bin first{centre[0] + di, centre[1] + dj, centre[2] - 1};
      const Bin last{centre[0] + di, centre[1] + dj, centre[2] + 1};
      auto p = std::lower_bound(points_.begin(), points_.end(), first,
                                [](const Point& a, const Bin& b) { return a.bin < b; });
      for (; p != points_.end() && p->bin <= last; ++p) {
        const double room = (size - p->size) / sizes_.grading;  // nearer than this it counts
        if (room <= 0) continue;
        const double distance_squared = norm_squared(p->position - x);
        if (distance_squared < room * room) size = p->size + sizes_.grading * std::sqrt(distance_squared);
      }
    }
}

}  // namespace spume::meshing
