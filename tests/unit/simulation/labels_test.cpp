#include "spume/simulation/labels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spume/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace spume::simulation {
namespace {

const grid::Box box{{0, 0, 0}, {4e-3, 4e-3, 4e-3}, {20, 20, 20}};

/// A case of two slabs: label 1 for x below the middle, 2 above, by the image of n³ voxels that fills the
/// box.
io::LabelledImage two_slabs(int n) {
  io::LabelledImage image;
  image.voxels = {n, n, n};
  image.lower = box.lower;
  image.spacing = (4e-3 / n) * Vec3{1, 1, 1};
  image.label = {1, 2};
  for (int v = 0; v < n * n * n; ++v) image.phase.push_back(v % n < n / 2 ? 1 : 2);
  return image;
}

// Images finer and coarser than the grid.
TEST(LabelPotentials, AreDistancesNearAFlatFilm) {
  for (const int n : {10, 20, 80}) {
    const LabelPotentials potential(two_slabs(n), box);
    for (const double depth : {-1e-4, 0.0, 1e-4}) {
      const Vec3 x{2e-3 + depth, 1.1e-3, 1.3e-3};
      EXPECT_NEAR(0.5 * (potential(2, x) - potential(1, x)), depth, 0.15e-4) << n;
    }
  }
}

TEST(LabelPotentials, ContinueThroughPeriodicFacesAndEndAtOthers) {
  const LabelPotentials periodic(two_slabs(20), box);
  const Vec3 corner{1e-5, 1e-5, 1e-5};  // phase 1, a film to 2 on the periodic face, and no outside
  EXPECT_GT(periodic(1, corner), periodic(2, corner));
  EXPECT_LT(periodic(1, corner) - periodic(2, corner), 1e-4);
  EXPECT_LT(periodic(0, corner), periodic(2, corner));
  grid::Box walled = box;
  walled.boundary.fill(grid::Boundary::Wall);
  const LabelPotentials bounded(two_slabs(20), walled);
  EXPECT_GT(bounded(0, corner), bounded(1, corner)) << "beyond the image is outside";
}

TEST(LoadLabels, PlacesTheImage) {
  const testing::ScratchFolder folder;
  const auto file = folder.path() / "a.mha";
  std::ofstream(file) << "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nOffset = 1e-3 1e-3 1e-3\n"
                         "ElementSpacing = 1e-3 1e-3 1e-3\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
                      << std::string("\0\1\1\1\1\1\1\3", 8);
  LabelsSource source{file.string(), LabelsSource::Placement::Box};
  const auto stretched = load_labels(source, box);
  EXPECT_EQ(stretched.lower, box.lower);
  EXPECT_EQ(stretched.spacing, (Vec3{2e-3, 2e-3, 2e-3}));
  EXPECT_NEAR(label_volumes(stretched)[1], 6 * 8e-9, 1e-20);
  EXPECT_EQ(label_at(stretched, {3e-3, 3e-3, 3e-3}), 2);

  grid::Box flat = box;
  flat.upper.z = 2e-3;
  flat.cells.k /= 2;
  EXPECT_THROW(load_labels(source, flat), InputError) << "its voxels would not stay cubes";

  source.placement = LabelsSource::Placement::File;
  const auto placed = load_labels(source, box);
  EXPECT_NEAR(placed.lower.x, 0.5e-3, 1e-15) << "the offset is the middle of the first voxel";
  EXPECT_NEAR(label_centroids(placed)[2].z, 2e-3, 1e-15);
  EXPECT_EQ(label_at(placed, {3e-3, 3e-3, 3e-3}), 0) << "beyond the image";
  grid::Box small = box;
  small.upper = {2e-3, 2e-3, 2e-3};
  EXPECT_THROW(load_labels(source, small), InputError);
}

}  // namespace
}  // namespace spume::simulation
