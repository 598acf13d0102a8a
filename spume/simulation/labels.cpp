#include "spume/simulation/labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "spume/base/error.hpp"

namespace spume::simulation {

namespace {

constexpr double rounding = 1e-6;  // of places, in voxels

int wrapped(int c, int n) {
  const int r = c % n;
  return r < 0 ? r + n : r;
}

template <class Body>
void for_each_voxel(const Index3& voxels, Body&& body) {
  std::size_t n = 0;
  for (int k = 0; k < voxels.k; ++k)
    for (int j = 0; j < voxels.j; ++j)
      for (int i = 0; i < voxels.i; ++i) body(n++, i, j, k);
}

/// The image keeps its proportions.
void stretch_over(const grid::Box& box, const std::string& file, io::LabelledImage& image) {
  constexpr double largest_distortion = 0.01;
  Vec3 factor;
  for (int d = 0; d < 3; ++d) factor[d] = box.size()[d] / (image.voxels[d] * image.spacing[d]);
  const auto [least, most] = std::minmax({factor.x, factor.y, factor.z});
  if (most > (1 + largest_distortion) * least)
    throw InputError(fmt::format(
        "{}: the image has sides in the ratio {:.4g} : {:.4g} : {:.4g}, the box {:.4g} : {:.4g} : {:.4g}: it "
        "would be stretched more along one axis than along another; give [domain] the proportions of the "
        "image, or the file the spacing of its voxels",
        file, 1.0, image.voxels.j * image.spacing.y / (image.voxels.i * image.spacing.x),
        image.voxels.k * image.spacing.z / (image.voxels.i * image.spacing.x), 1.0,
        box.size().y / box.size().x, box.size().z / box.size().x));
  image.lower = box.lower;
  for (int d = 0; d < 3; ++d) image.spacing[d] *= factor[d];
}

void place_in_box(const LabelsSource& source, const grid::Box& box, io::LabelledImage& image) {
  if (source.placement == LabelsSource::Placement::Box) {
    stretch_over(box, source.file, image);
    return;
  }
  for (int d = 0; d < 3; ++d) {
    const double upper = image.lower[d] + image.voxels[d] * image.spacing[d];
    const double slack = rounding * image.spacing[d];
    if (image.lower[d] < box.lower[d] - slack || upper > box.upper[d] + slack)
      throw InputError(fmt::format(
          "{}: by its own origin and spacing the image reaches from {:.6g} to {:.6g} m along {}, beyond the "
          "box from {:.6g} to {:.6g} m; with foam.labels.placement = \"box\" it is stretched over the box",
          source.file, image.lower[d], upper, "xyz"[d], box.lower[d], box.upper[d]));
  }
}

}  // namespace

io::LabelledImage load_labels(const LabelsSource& source, const grid::Box& box) {
  io::LabelledImage image = io::read_labelled_image(source.file);
  constexpr double fewest_cells = 2.5;  // across a bubble that the grid can hold at all
  const double n_cells = static_cast<double>(box.cells.i) * box.cells.j * box.cells.k;
  if (image.n_bubbles() > n_cells / std::pow(fewest_cells, 3))
    throw InputError(
        fmt::format("{}: has {} labels, more bubbles than a grid of {} × {} × {} cells can hold; is it a "
                    "labelled image?",
                    source.file, image.n_bubbles(), box.cells.i, box.cells.j, box.cells.k));
  place_in_box(source, box, image);
  return image;
}

std::vector<double> label_volumes(const io::LabelledImage& image) {
  std::vector<double> volume(image.n_bubbles() + 1, 0.0);
  for (int p : image.phase) volume[p] += 1;
  for (double& v : volume) v *= image.spacing.x * image.spacing.y * image.spacing.z;
  return volume;
}

std::vector<Vec3> label_centroids(const io::LabelledImage& image) {
  std::vector<Vec3> centroid(image.n_bubbles() + 1);
  std::vector<double> count(image.n_bubbles() + 1, 0.0);
  for_each_voxel(image.voxels, [&](std::size_t n, int i, int j, int k) {
    centroid[image.phase[n]] += Vec3{i + 0.5, j + 0.5, k + 0.5};
    count[image.phase[n]] += 1;
  });
  for (std::size_t p = 0; p < centroid.size(); ++p)
    for (int d = 0; d < 3; ++d)
      centroid[p][d] = image.lower[d] + image.spacing[d] * centroid[p][d] / std::max(1.0, count[p]);
  return centroid;
}

int label_at(const io::LabelledImage& image, const Vec3& x) {
  Index3 voxel;
  for (int d = 0; d < 3; ++d) {
    voxel[d] = static_cast<int>(std::floor((x[d] - image.lower[d]) / image.spacing[d]));
    if (voxel[d] < 0 || voxel[d] >= image.voxels[d]) return 0;
  }
  return image
      .phase[(static_cast<std::size_t>(voxel.k) * image.voxels.j + voxel.j) * image.voxels.i + voxel.i];
}

LabelPotentials::LabelPotentials(const io::LabelledImage& image, const grid::Box& box)
    : lower_(image.lower), spacing_(image.spacing), voxels_(image.voxels) {
  for (int d = 0; d < 3; ++d)
    periodic_[d] = box.boundary[d] == grid::Boundary::Periodic &&
                   std::abs(image.voxels[d] * image.spacing[d] - box.size()[d]) < rounding * image.spacing[d];
  smoothing_ = std::max({0.75 * box.spacing(), spacing_.x, spacing_.y, spacing_.z});

  const int n_phases = image.n_bubbles() + 1;
  std::vector<Index3> first(n_phases, voxels_), last(n_phases, {-1, -1, -1});
  first[0] = {0, 0, 0};
  last[0] = {voxels_.i - 1, voxels_.j - 1, voxels_.k - 1};
  for_each_voxel(voxels_, [&](std::size_t n, int i, int j, int k) {
    const int p = image.phase[n];
    first[p] = {std::min(first[p].i, i), std::min(first[p].j, j), std::min(first[p].k, k)};
    last[p] = {std::max(last[p].i, i), std::max(last[p].j, j), std::max(last[p].k, k)};
  });
  for (int p = 0; p < n_phases; ++p) field_.push_back(smooth(image.phase, p, first[p], last[p]));
}

LabelPotentials::Field LabelPotentials::smooth(const std::vector<int>& phase, mesh::Phase p,
                                               const Index3& first, const Index3& last) const {
  Field field{first, last, {}, p == 0 ? 1.0f : 0.0f};
  for (int d = 0; d < 3; ++d) {
    const int reach = static_cast<int>(std::ceil(3 * smoothing_ / spacing_[d])) + 1;
    field.begin[d] -= reach;
    field.end[d] += reach + 1;
    if (periodic_[d] && field.end[d] - field.begin[d] >= voxels_[d]) {
      field.begin[d] = 0;
      field.end[d] = voxels_[d];
    }
  }
  for (int k = field.begin.k; k < field.end.k; ++k)
    for (int j = field.begin.j; j < field.end.j; ++j)
      for (int i = field.begin.i; i < field.end.i; ++i) {
        Index3 voxel{i, j, k};
        bool in_image = true;
        for (int d = 0; d < 3; ++d) {
          if (periodic_[d]) voxel[d] = wrapped(voxel[d], voxels_[d]);
          in_image = in_image && voxel[d] >= 0 && voxel[d] < voxels_[d];
        }
        const int here =
            in_image ? phase[(static_cast<std::size_t>(voxel.k) * voxels_.j + voxel.j) * voxels_.i + voxel.i]
                     : 0;
        field.value.push_back(here == p ? 1.0f : 0.0f);
      }
  for (int d = 0; d < 3; ++d) smooth_along(d, field);
  return field;
}

void LabelPotentials::smooth_along(int axis, Field& field) const {
  const double deviation = smoothing_ / spacing_[axis];
  const int reach = static_cast<int>(std::ceil(3 * deviation));
  std::vector<float> weight;
  for (int m = -reach; m <= reach; ++m)
    weight.push_back(static_cast<float>(std::exp(-0.5 * m * m / (deviation * deviation))));
  const float sum = std::accumulate(weight.begin(), weight.end(), 0.0f);
  for (float& w : weight) w /= sum;

  const Index3 n{field.end.i - field.begin.i, field.end.j - field.begin.j, field.end.k - field.begin.k};
  const std::array<std::size_t, 3> strides{1, static_cast<std::size_t>(n.i),
                                           static_cast<std::size_t>(n.i) * n.j};
  const bool closed = periodic_[axis] && n[axis] == voxels_[axis];
  const std::size_t stride = strides[axis];
  std::vector<float> line(n[axis]);
  for_each_voxel(n, [&](std::size_t start, int i, int j, int k) {
    if (Index3{i, j, k}[axis] != 0) return;
    for (int m = 0; m < n[axis]; ++m) line[m] = field.value[start + m * stride];
    for (int m = 0; m < n[axis]; ++m) {
      float value = 0;
      for (int r = -reach; r <= reach; ++r) {
        const int from = closed ? wrapped(m + r, n[axis]) : m + r;
        value += weight[r + reach] * (from >= 0 && from < n[axis] ? line[from] : field.beyond);
      }
      field.value[start + m * stride] = value;
    }
  });
}

float LabelPotentials::at(const Field& field, int i, int j, int k) const {
  Index3 voxel{i, j, k};
  for (int d = 0; d < 3; ++d) {
    if (periodic_[d]) voxel[d] = field.begin[d] + wrapped(voxel[d] - field.begin[d], voxels_[d]);
    if (voxel[d] < field.begin[d] || voxel[d] >= field.end[d]) return field.beyond;
  }
  const Index3 n{field.end.i - field.begin.i, field.end.j - field.begin.j, 0};
  return field
      .value[(static_cast<std::size_t>(voxel.k - field.begin.k) * n.j + (voxel.j - field.begin.j)) * n.i +
             (voxel.i - field.begin.i)];
}

double LabelPotentials::operator()(mesh::Phase phase, const Vec3& x) const {
  constexpr double floor = 1e-3, logistic = 1.702;
  const Field& field = field_[phase];
  Index3 base;
  Vec3 t;
  for (int d = 0; d < 3; ++d) {
    const double place = (x[d] - lower_[d]) / spacing_[d] - 0.5;
    base[d] = static_cast<int>(std::floor(place));
    t[d] = place - base[d];
  }
  double c = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
    const double weight = (di ? t.x : 1 - t.x) * (dj ? t.y : 1 - t.y) * (dk ? t.z : 1 - t.z);
    c += weight * at(field, base.i + di, base.j + dj, base.k + dk);
  }
  c = std::clamp(c, floor, 1 - floor);
  return smoothing_ / logistic * std::log(c / (1 - c));
}

}  // namespace spume::simulation
