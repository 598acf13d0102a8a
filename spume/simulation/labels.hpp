#pragma once

#include <array>
#include <vector>

#include "spume/grid/box.hpp"
#include "spume/io/labelled_image.hpp"
#include "spume/mesh/phase_set.hpp"
#include "spume/simulation/case.hpp"

namespace spume::simulation {

/// The image with its place in the box: lower corner and spacing in metres. Throws InputError when it cannot
/// be read, when the grid has too few cells for so many bubbles, when an image to be stretched has other
/// proportions than the box by more than 1 %, and when a placed image is not in the box.
io::LabelledImage load_labels(const LabelsSource& source, const grid::Box& box);

/// Volume of every phase in the image [m³], the outside first; of what lies beyond the image nothing counts.
std::vector<double> label_volumes(const io::LabelledImage& image);
/// Mean place of the voxels of every phase [m], the outside first.
std::vector<Vec3> label_centroids(const io::LabelledImage& image);
/// The phase at a point by its voxel; 0 beyond the image.
int label_at(const io::LabelledImage& image, const Vec3& x);

/// Potentials of the phases of an image: every label's indicator is smoothed by a Gaussian of standard
/// deviation s (¾ of a cell, but at least one voxel), c, and turned into the distance (s/1.702) ln(c/(1 − c))
/// that it is near a flat film (1.702: the logistic function for the error function). Beyond the image is
/// outside; where the image fills a periodic direction of the box it continues there.
class LabelPotentials {
 public:
  LabelPotentials(const io::LabelledImage& image, const grid::Box& box);
  double operator()(mesh::Phase phase, const Vec3& x) const;  ///< by linear interpolation [m]

 private:
  /// c of one phase on a block of voxels, which may reach beyond the image.
  struct Field {
    Index3 begin, end;
    std::vector<float> value;
    float beyond;
  };
  Field smooth(const std::vector<int>& phase, mesh::Phase p, const Index3& first, const Index3& last) const;
  void smooth_along(int axis, Field& field) const;
  float at(const Field& field, int i, int j, int k) const;

  Vec3 lower_, spacing_;
  Index3 voxels_;
  std::array<bool, 3> periodic_{};
  double smoothing_;  ///< s [m]
  std::vector<Field> field_;
};

}  // namespace spume::simulation
