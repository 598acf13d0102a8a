#include "spume/mesh/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "spume/base/contract.hpp"

namespace spume::mesh {
namespace {

constexpr double largest_number_of_bins = 1 << 22;

struct BinRange {
  std::array<int, 3> first, last;
};

/// Bins that a box touches, cut to those there are; empty (first > last) when it touches none.
BinRange bins_of_box(const Vec3& low, const Vec3& high, const Vec3& origin, double bin_size,
                     const std::array<int, 3>& n_bins) {
  BinRange range;
  for (int axis = 0; axis < 3; ++axis) {
    const double top = n_bins[axis];
    range.first[axis] =
        static_cast<int>(std::clamp(std::floor((low[axis] - origin[axis]) / bin_size), 0.0, top));
    range.last[axis] =
        static_cast<int>(std::clamp(std::floor((high[axis] - origin[axis]) / bin_size), -1.0, top - 1));
  }
  return range;
}

template <class Visit>
void for_each_bin(const BinRange& range, const std::array<int, 3>& n_bins, Visit visit) {
  for (int k = range.first[2]; k <= range.last[2]; ++k)
    for (int j = range.first[1]; j <= range.last[1]; ++j)
      for (int i = range.first[0]; i <= range.last[0]; ++i) visit((k * n_bins[1] + j) * n_bins[0] + i);
}

/// Bins at exactly `ring` steps (in the largest of the three directions) from the centre: visit(bin, i, j,
/// k).
template <class Visit>
void for_each_bin_of_ring(const std::array<int, 3>& centre, int ring, const std::array<int, 3>& n_bins,
                          Visit visit) {
  const auto low = [&](int axis) { return std::max(centre[axis] - ring, 0); };
  const auto high = [&](int axis) { return std::min(centre[axis] + ring, n_bins[axis] - 1); };
  for (int k = low(2); k <= high(2); ++k)
    for (int j = low(1); j <= high(1); ++j) {
      const bool on_face = std::abs(k - centre[2]) == ring || std::abs(j - centre[1]) == ring;
      const int row = (k * n_bins[1] + j) * n_bins[0];
      if (on_face) {
        for (int i = low(0); i <= high(0); ++i) visit(row + i, i, j, k);
      } else {
        if (centre[0] - ring >= 0) visit(row + centre[0] - ring, centre[0] - ring, j, k);
        if (centre[0] + ring < n_bins[0]) visit(row + centre[0] + ring, centre[0] + ring, j, k);
      }
    }
}

}  // namespace

double closest_point_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c,
                                 std::array<double, 3>& weight) {
  const Vec3 ab = b - a, ac = c - a;
  const auto closest_on_edge = [&](int from, int to, const Vec3& p, const Vec3& q, double& best) {
    const Vec3 d = q - p;
    const double length_squared = norm_squared(d);
    const double s = length_squared > 0 ? std::clamp(dot(x - p, d) / length_squared, 0.0, 1.0) : 0.0;
    const double distance_squared = norm_squared(x - (p + s * d));
    if (distance_squared >= best) return;
    best = distance_squared;
    weight = {};
    weight[from] = 1 - s;
    weight[to] = s;
  };

  const Vec3 n = cross(ab, ac);
  const double n2 = norm_squared(n);
  if (n2 > 0) {
    const double wb = dot(cross(x - a, ac), n) / n2;
    const double wc = dot(cross(ab, x - a), n) / n2;
    if (wb >= 0 && wc >= 0 && wb + wc <= 1) {
      weight = {1 - wb - wc, wb, wc};
      return norm_squared(x - (a + wb * ab + wc * ac));
    }
  }
  double best = std::numeric_limits<double>::infinity();
  closest_on_edge(0, 1, a, b, best);
  closest_on_edge(1, 2, b, c, best);
  closest_on_edge(2, 0, c, a, best);
  return best;
}

TriangleLocator::TriangleLocator(const FilmMesh& mesh, double bin_size)
    : mesh_(&mesh), bin_size_(bin_size), n_bins_{0, 0, 0} {
  expects(bin_size > 0, "bins have a size");
  if (mesh.triangle.empty()) return;
  is_inside_ = std::ranges::all_of(mesh.position, [&](const Vec3& x) { return mesh.domain.inside(x) == x; });
  struct Box {
    Vec3 low, high;
  };
  std::vector<Box> box(mesh.triangle.size());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto [a, b, c] = stored_corners(t);
    for (int axis = 0; axis < 3; ++axis)
      std::tie(box[t].low[axis], box[t].high[axis]) = std::minmax({a[axis], b[axis], c[axis]});
  }
  Vec3 corner;
  origin_ = corner = box[0].low;
  for (const auto& [low, high] : box) {
    longest_edge_ = std::max(longest_edge_, norm(high - low));
    for (int axis = 0; axis < 3; ++axis) {
      origin_[axis] = std::min(origin_[axis], low[axis]);
      corner[axis] = std::max(corner[axis], high[axis]);
    }
  }
  const auto bins_along = [&](int axis) {
    return std::floor((corner[axis] - origin_[axis]) / bin_size_) + 1;
  };
  while (bins_along(0) * bins_along(1) * bins_along(2) > largest_number_of_bins) bin_size_ *= 2;
  for (int axis = 0; axis < 3; ++axis) n_bins_[axis] = static_cast<int>(bins_along(axis));

  std::vector<BinRange> bins(box.size());
  std::ranges::transform(box, bins.begin(), [&](const Box& b) {
    return bins_of_box(b.low, b.high, origin_, bin_size_, n_bins_);
  });
  bin_offset_.assign(static_cast<std::size_t>(n_bins_[0]) * n_bins_[1] * n_bins_[2] + 1, 0);
  for (const BinRange& range : bins) for_each_bin(range, n_bins_, [&](int bin) { ++bin_offset_[bin]; });
  std::partial_sum(bin_offset_.begin(), bin_offset_.end(), bin_offset_.begin());
  bin_triangle_.resize(bin_offset_.back());
  // From the last to the first, each before those that are there: then offsets are where bins begin.
  for (int t = mesh.n_triangles() - 1; t >= 0; --t)
    for_each_bin(bins[t], n_bins_, [&](int bin) { bin_triangle_[--bin_offset_[bin]] = t; });
}

SurfacePoint TriangleLocator::closest(const Vec3& x, double reach,
                                      const std::function<bool(int triangle)>& accept) const {
  SurfacePoint found;
  if (bin_triangle_.empty()) return found;
  double best_squared = reach * reach;
  // Triangles are stored with their first corner in the box.
  mesh_->domain.for_each_image(x, reach + longest_edge_,
                               [&](const Vec3& image) { search(image, accept, best_squared, found); });
  if (found.triangle >= 0) found.distance = std::sqrt(best_squared);
  return found;
}

std::array<Vec3, 3> TriangleLocator::stored_corners(int t) const {
  const auto [a, b, c] = mesh_->corners(t);
  if (is_inside_) return {a, b, c};
  const Vec3 shift = mesh_->domain.inside(a) - a;
  return {a + shift, b + shift, c + shift};
}

void TriangleLocator::search(const Vec3& x, const std::function<bool(int triangle)>& accept, double& best,
                             SurfacePoint& found) const {
  // With x₀ the closest point of the box of bins to x, |x − p|² ≥ |x − x₀|² + |x₀ − p|² for every p in the
  // box, and a point in ring r around the bin of x₀ is at least r − 1 bins away from x₀.
  std::array<int, 3> centre;
  int last_ring = 0;
  double outside_squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = n_bins_[axis] * bin_size_;
    const double along = x[axis] - origin_[axis];
    const double inside = std::clamp(along, 0.0, size);
    outside_squared += (along - inside) * (along - inside);
    centre[axis] = std::min(static_cast<int>(inside / bin_size_), n_bins_[axis] - 1);
    last_ring = std::max({last_ring, centre[axis], n_bins_[axis] - 1 - centre[axis]});
  }
  constexpr double hair = 1 - 1e-12;  // keeps round-off from cutting off the first of equals
  // Squared distance of x to the bin (i, j, k): the closest point of a triangle lies in a bin that has it.
  const auto bin_distance_squared = [&](const std::array<int, 3>& bin) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = x[axis] - origin_[axis] - bin[axis] * bin_size_;
      const double off = std::max({-along, along - bin_size_, 0.0}) - 1e-9 * bin_size_;
      if (off > 0) sum += off * off;
    }
    return sum;
  };
  for (int ring = 0; ring <= last_ring; ++ring) {
    const double gap = std::max(ring - 1, 0) * bin_size_;
    if ((outside_squared + gap * gap) * hair > best) break;
    for_each_bin_of_ring(centre, ring, n_bins_, [&](int bin, int i, int j, int k) {
      if (bin_offset_[bin] == bin_offset_[bin + 1] || bin_distance_squared({i, j, k}) * hair > best) return;
      for (int n = bin_offset_[bin]; n < bin_offset_[bin + 1]; ++n) {
        const int t = bin_triangle_[n];
        if (t == found.triangle && !mesh_->domain.is_periodic()) continue;
        const auto [a, b, c] = stored_corners(t);
        std::array<double, 3> weight;
        const double distance_squared = closest_point_on_triangle(x, a, b, c, weight);
        const bool better = distance_squared < best ||
                            (distance_squared == best && (found.triangle < 0 || t < found.triangle));
        if (!better || (accept && !accept(t))) continue;
        best = distance_squared;
        found.triangle = t;
        found.weight = weight;
      }
    });
  }
}

std::vector<int> TriangleLocator::near(const Vec3& x, double radius) const {
  std::vector<int> triangles;
  if (bin_triangle_.empty()) return triangles;
  const Vec3 half{radius, radius, radius};
  mesh_->domain.for_each_image(x, radius + longest_edge_, [&](const Vec3& image) {
    for_each_bin(bins_of_box(image - half, image + half, origin_, bin_size_, n_bins_), n_bins_, [&](int bin) {
      triangles.insert(triangles.end(), bin_triangle_.begin() + bin_offset_[bin],
                       bin_triangle_.begin() + bin_offset_[bin + 1]);
    });
  });
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace spume::mesh
