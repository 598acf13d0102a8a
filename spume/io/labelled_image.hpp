#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "spume/base/index3.hpp"
#include "spume/base/vec3.hpp"

namespace spume::io {

/// A voxel image in which every bubble has a label, as segmented tomography gives it.
struct LabelledImage {
  Index3 voxels;                    ///< along x, y, z
  Vec3 lower;                       ///< outer corner of the first voxel, in units of the file
  Vec3 spacing{1, 1, 1};            ///< edges of a voxel, in units of the file
  std::vector<int> phase;           ///< of each voxel, x fastest: 0 the outside, bubbles in order of labels
  std::vector<std::int64_t> label;  ///< of bubbles 1, 2, …, increasing

  int n_bubbles() const { return static_cast<int>(label.size()); }
};

/// Reads VTK image data (.vti; its points, or without point data its cells, are the voxels), MetaImage
/// (.mha, .mhd) or NRRD (.nrrd, .nhdr). Label 0 is the outside. Throws InputError when the file is missing,
/// damaged, of another format, no volume of whole numbers ≥ 0 with one number a voxel, or has no bubble.
LabelledImage read_labelled_image(const std::filesystem::path& path);

}  // namespace spume::io
