#pragma once

#include <array>
#include <vector>

#include "spume/base/domain.hpp"
#include "spume/base/vec3.hpp"

namespace spume::transport {

/// A point near another one.
struct Neighbour {
  int point;
  double distance_squared;  ///< [m²]
};

/// Points sorted into cubes, to find those in a ball without looking at all of them.
class PointBins {
 public:
  /// Bins of edge `bin_size` [m], or larger where that would make more than two bins a point. In a periodic
  /// domain all images of the points count.
  PointBins(std::vector<Vec3> points, double bin_size, const Domain& domain = {});

  /// The points nearer to x than `radius`, in increasing order, each once; replaces the content of `found`.
  void within(const Vec3& x, double radius, std::vector<Neighbour>& found) const;

 private:
  std::array<int, 3> bin_of(const Vec3& x) const;

  void collect(const Vec3& x, double radius, std::vector<Neighbour>& found) const;

  Domain domain_;
  std::vector<Vec3> points_;
  double bin_size_;
  Vec3 origin_;
  std::array<int, 3> n_bins_{1, 1, 1};
  std::vector<int> bin_offset_, bin_point_;
};

}  // namespace spume::transport
