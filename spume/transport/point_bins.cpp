#include "spume/transport/point_bins.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace spume::transport {

PointBins::PointBins(std::vector<Vec3> points, double bin_size, const Domain& domain)
    : domain_(domain), points_(std::move(points)), bin_size_(bin_size) {
  for (Vec3& p : points_) p = domain_.inside(p);
  Vec3 upper;
  if (!points_.empty()) origin_ = upper = points_.front();
  for (const Vec3& p : points_)
    for (int axis = 0; axis < 3; ++axis) {
      origin_[axis] = std::min(origin_[axis], p[axis]);
      upper[axis] = std::max(upper[axis], p[axis]);
    }
  // Balls of two or three bins are asked for, a few of them: more bins than points cost more to make than
  // they spare.
  const double most_bins = 64.0 + 2.0 * static_cast<double>(points_.size());
  const auto bins_along = [&](int axis) { return std::floor((upper[axis] - origin_[axis]) / bin_size_) + 1; };
  while (bins_along(0) * bins_along(1) * bins_along(2) > most_bins) bin_size_ *= 2;
  for (int axis = 0; axis < 3; ++axis) n_bins_[axis] = static_cast<int>(bins_along(axis));

  const auto number = [&](const Vec3& p) {
    const auto [i, j, k] = bin_of(p);
    return (k * n_bins_[1] + j) * n_bins_[0] + i;
  };
  std::vector<int> bin(points_.size());
  std::transform(points_.begin(), points_.end(), bin.begin(), number);
  bin_offset_.assign(n_bins_[0] * n_bins_[1] * n_bins_[2] + 1, 0);
  for (int b : bin) ++bin_offset_[b + 1];
  for (std::size_t b = 1; b < bin_offset_.size(); ++b) bin_offset_[b] += bin_offset_[b - 1];
  bin_point_.resize(points_.size());
  std::vector<int> next(bin_offset_.begin(), bin_offset_.end() - 1);
  for (std::size_t p = 0; p < points_.size(); ++p) bin_point_[next[bin[p]]++] = static_cast<int>(p);
}

std::array<int, 3> PointBins::bin_of(const Vec3& x) const {
  std::array<int, 3> bin;
  for (int axis = 0; axis < 3; ++axis) {
    const double position = std::floor((x[axis] - origin_[axis]) / bin_size_);
    bin[axis] = static_cast<int>(std::clamp(position, 0.0, n_bins_[axis] - 1.0));
  }
  return bin;
}

void PointBins::within(const Vec3& x, double radius, std::vector<Neighbour>& found) const {
  found.clear();
  if (points_.empty()) return;
  domain_.for_each_image(x, radius, [&](const Vec3& image) { collect(image, radius, found); });
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return std::tie(a.point, a.distance_squared) < std::tie(b.point, b.distance_squared);
  });
  // In a ball larger than half the box a point has several images: the nearest counts.
  found.erase(std::unique(found.begin(), found.end(),
                          [](const Neighbour& a, const Neighbour& b) { return a.point == b.point; }),
              found.end());
}

void PointBins::collect(const Vec3& x, double radius, std::vector<Neighbour>& found) const {
  const Vec3 reach{radius, radius, radius};
  const auto low = bin_of(x - reach), high = bin_of(x + reach);
  const double radius_squared = radius * radius;
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j) {
      const int row = (k * n_bins_[1] + j) * n_bins_[0];
      for (int s = bin_offset_[row + low[0]]; s < bin_offset_[row + high[0] + 1]; ++s) {
        const double r2 = norm_squared(points_[bin_point_[s]] - x);
        if (r2 < radius_squared) found.push_back({bin_point_[s], r2});
      }
    }
}

}  // namespace spume::transport
