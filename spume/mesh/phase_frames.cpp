#include "spume/mesh/phase_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spume::mesh {

namespace {

constexpr int n_bins = 128;  // along a periodic direction

/// Which parts of a periodic direction the films of one phase take up.
struct Occupancy {
  std::array<char, n_bins> taken{};

  /// The whole range [low, high] in units of bins, low anywhere.
  void take(double low, double high) {
    if (low >= 0 && high < n_bins) {
      const int last = static_cast<int>(high);
      for (int bin = static_cast<int>(low); bin <= last; ++bin) taken[bin] = 1;
      return;
    }
    const double first = std::floor(low);
    const int n = static_cast<int>(std::min<double>(std::floor(high) - first + 1, n_bins));
    int bin = static_cast<int>(first - n_bins * std::floor(first / n_bins));
    for (int m = 0; m < n; ++m, bin = bin + 1 == n_bins ? 0 : bin + 1) taken[bin] = 1;
  }
  /// Middle of what is taken, in bins: opposite to the middle of the longest gap; negative without a gap.
  double middle() const {
    int longest = 0, end_of_longest = 0, length = 0;
    for (int m = 0; m < 2 * n_bins; ++m) {
      length = taken[m % n_bins] ? 0 : length + 1;
      if (length > longest && length <= n_bins) {
        longest = length;
        end_of_longest = m + 1;
      }
    }
    if (longest == 0) return -1;
    const double middle_of_gap = end_of_longest - 0.5 * longest;
    return std::fmod(middle_of_gap + 0.5 * n_bins, n_bins);
  }
};

Vec3 smaller(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 larger(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
Vec3 lowest(const std::array<Vec3, 3>& corner) {
  return smaller(smaller(corner[0], corner[1]), corner[2]);
}
Vec3 highest(const std::array<Vec3, 3>& corner) {
  return larger(larger(corner[0], corner[1]), corner[2]);
}

}  // namespace

PhaseFrames::PhaseFrames(const FilmMesh& mesh, int n_phases) : domain_(mesh.domain), frame_(n_phases) {
  as_stored_ = take_as_stored(mesh);
  if (!as_stored_) take_images(mesh);
  for (Frame& f : frame_) f.middle = 0.5 * (f.lower + f.upper);
}

/// Most foams lie inside their box, also a periodic one. Then triangles are stored in one piece, and so is
/// each phase, as long as a part of the box as wide as two bins is left free: no image is nearer to its
/// middle.
bool PhaseFrames::take_as_stored(const FilmMesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  frame_.assign(frame_.size(), Frame{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, {}});
  Vec3 half{infinity, infinity, infinity}, widest = half;
  for (int d = 0; d < 3; ++d)
    if (domain_.periodic[d]) {
      half[d] = 0.5 * domain_.size[d];
      widest[d] = (1 - 2.0 / n_bins) * domain_.size[d];
    }
  const auto fits = [](const Vec3& extent, const Vec3& limit) {
    return extent.x <= limit.x && extent.y <= limit.y && extent.z <= limit.z;
  };
  for (const FilmTriangle& t : mesh.triangle) {
    const std::array<Vec3, 3> corner{mesh.position[t.vertex[0]], mesh.position[t.vertex[1]],
                                     mesh.position[t.vertex[2]]};
    const Vec3 low = lowest(corner), high = highest(corner);
    if (!fits(high - low, half)) return false;
    for (Phase p : {t.phase_a, t.phase_b}) {
      frame_[p].lower = smaller(frame_[p].lower, low);
      frame_[p].upper = larger(frame_[p].upper, high);
    }
  }
  return std::all_of(frame_.begin(), frame_.end(),
                     [&](const Frame& f) { return fits(f.upper - f.lower, widest); });
}

void PhaseFrames::take_images(const FilmMesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto n_phases = static_cast<Phase>(frame_.size());
  frame_.assign(n_phases, Frame{});
  std::vector<Vec3> middle(n_phases);
  std::vector<std::array<Occupancy, 3>> occupancy(n_phases);
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto corner = mesh.corners(t);
    const Vec3 low = lowest(corner) - domain_.lower, high = highest(corner) - domain_.lower;
    auto &a = occupancy[mesh.triangle[t].phase_a], &b = occupancy[mesh.triangle[t].phase_b];
    for (int d = 0; d < 3; ++d) {
      if (!domain_.periodic[d]) continue;
      const double bins_per_length = n_bins / domain_.size[d];
      a[d].take(low[d] * bins_per_length, high[d] * bins_per_length);
      b[d].take(low[d] * bins_per_length, high[d] * bins_per_length);
    }
  }
  for (int d = 0; d < 3; ++d) {
    if (!domain_.periodic[d]) continue;
    for (Phase p = 0; p < n_phases; ++p) {
      const double bin = occupancy[p][d].middle();
      frame_[p].bounded[d] = bin >= 0;
      middle[p][d] = domain_.lower[d] + (bin >= 0 ? bin * domain_.size[d] / n_bins : 0.5 * domain_.size[d]);
    }
  }
  for (Frame& f : frame_) {
    f.lower = {infinity, infinity, infinity};
    f.upper = -f.lower;
    f.n_bounded = f.bounded[0] + f.bounded[1] + f.bounded[2];
  }
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto corner = mesh.corners(t);
    const Vec3 low = lowest(corner), high = highest(corner);
    for (Phase p : {mesh.triangle[t].phase_a, mesh.triangle[t].phase_b}) {
      Frame& f = frame_[p];
      const Vec3 shift = domain_.near(corner[0], middle[p]) - corner[0];
      f.lower = smaller(f.lower, low + shift);
      f.upper = larger(f.upper, high + shift);
    }
  }
  for (Frame& f : frame_)
    for (int d = 0; d < 3; ++d)
      if (!f.bounded[d]) {
        f.lower[d] = domain_.lower[d];
        f.upper[d] = domain_.lower[d] + domain_.size[d];
      }
}

std::array<Vec3, 3> PhaseFrames::place(Phase p, const std::array<Vec3, 3>& corner) const {
  if (as_stored_) return corner;
  const Vec3 shift = domain_.near(corner[0], middle(p)) - corner[0];
  return {corner[0] + shift, corner[1] + shift, corner[2] + shift};
}

double PhaseFrames::cone_of_images(Phase p, const Vec3& centroid, const Vec3& area) const {
  const Frame& f = frame_[p];
  // A layer between walls has no closed surface: what it holds is counted from the bottom of the box.
  const Vec3 o = f.n_bounded == 3 ? middle(p) : domain_.lower;
  const Vec3 x = domain_.near(centroid, middle(p)) - o;
  if (f.n_bounded == 3) return (1.0 / 3) * dot(x, area);
  double sum = 0;
  for (int d = 0; d < 3; ++d)
    if (f.bounded[d]) sum += x[d] * area[d];
  return f.n_bounded > 0 ? sum / f.n_bounded : 0;
}

double PhaseFrames::volume(Phase p, double cones) const {
  const Frame& f = frame_[p];
  if (f.n_bounded == 3) return cones;
  if (f.n_bounded == 0) return std::numeric_limits<double>::quiet_NaN();
  return cones - domain_.volume() * std::floor(cones / domain_.volume());
}

bool stands_free(const FilmMesh& mesh, int n_phases) {
  const PhaseFrames frames(mesh, n_phases);
  const bool meets_outside =
      std::any_of(mesh.triangle.begin(), mesh.triangle.end(), [](const auto& t) { return t.phase_a == 0; });
  return meets_outside && frames.bounded(0, 0) && frames.bounded(0, 1) && frames.bounded(0, 2);
}

}  // namespace spume::mesh
