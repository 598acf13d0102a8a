#include "spume/io/labelled_image.hpp"

#include <gmock/gmock.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include <string>

#include "spume/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace spume::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string voxels("\0\7\7\0\0\2\2\0\0\7\2\0\0\0\0\0", 16);  // 4 × 2 × 2

std::string mha_header(const std::string& type) {
  return "ObjectType = Image\nNDims = 3\nDimSize = 4 2 2\nElementSpacing = 0.5 1 2\nOffset = 10 20 "
         "30\nElementType = " +
         type + "\nElementDataFile = LOCAL\n";
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void expect_sample(const LabelledImage& image) {
  EXPECT_EQ(image.voxels, (Index3{4, 2, 2}));
  EXPECT_EQ(image.spacing, (Vec3{0.5, 1, 2}));
  EXPECT_EQ(image.lower, (Vec3{9.75, 19.5, 29}));
  EXPECT_THAT(image.label, ElementsAre(2, 7));
  EXPECT_THAT(image.phase, ElementsAre(0, 2, 2, 0, 0, 1, 1, 0, 0, 2, 1, 0, 0, 0, 0, 0));
}

std::string complaint(const std::filesystem::path& path) {
  try {
    read_labelled_image(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(LabelledImage, ReadsMetaImages) {
  const testing::ScratchFolder folder;
  write(folder.path() / "a.mha", mha_header("MET_UCHAR") + voxels);
  expect_sample(read_labelled_image(folder.path() / "a.mha"));
}

// VTK takes a first axis of fewer than ten for the components of a voxel.
TEST(LabelledImage, ReadsNrrd) {
  const testing::ScratchFolder folder;
  write(folder.path() / "a.nrrd",
        "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 16 2 2\n"
        "space directions: (0.5,0,0) (0,1,0) (0,0,2)\nspace origin: (10,20,30)\nencoding: raw\n\n\7\2" +
            std::string(62, '\0'));
  const LabelledImage image = read_labelled_image(folder.path() / "a.nrrd");
  EXPECT_EQ(image.voxels, (Index3{16, 2, 2}));
  EXPECT_EQ(image.spacing, (Vec3{0.5, 1, 2}));
  EXPECT_EQ(image.lower, (Vec3{9.75, 19.5, 29}));
  EXPECT_THAT(image.label, ElementsAre(2, 7));
  EXPECT_EQ(image.phase[0], 2);
  EXPECT_EQ(image.phase[1], 1);
}

TEST(LabelledImage, ReadsVtkImages) {
  const testing::ScratchFolder folder;
  vtkNew<vtkImageData> data;
  data->SetDimensions(4, 2, 2);
  data->SetSpacing(0.5, 1, 2);
  data->SetOrigin(10, 20, 30);
  data->AllocateScalars(VTK_INT, 1);
  for (int n = 0; n < 16; ++n) static_cast<int*>(data->GetScalarPointer())[n] = voxels[n];
  const auto path = folder.path() / "a.vti";
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  writer->Write();
  expect_sample(read_labelled_image(path));
}

TEST(LabelledImage, SaysWhatIsWrong) {
  const testing::ScratchFolder folder;
  const auto path = folder.path() / "a.mha";
  EXPECT_THAT(complaint(path), HasSubstr("no such file"));
  write(path, "not an image");
  EXPECT_THAT(complaint(path), HasSubstr("damaged"));
  write(path, mha_header("MET_UCHAR") + "cut");
  EXPECT_THAT(complaint(path), HasSubstr("damaged"));
  write(folder.path() / "a.mhd",
        "ObjectType = Image\nNDims = 3\nDimSize = 4 2 2\nElementType = MET_UCHAR\nElementDataFile = a.raw\n");
  write(folder.path() / "a.raw", "cut");
  EXPECT_THAT(complaint(folder.path() / "a.mhd"), HasSubstr("a.raw is cut short"));
  write(path, mha_header("MET_FLOAT") + std::string(64, '\0'));
  EXPECT_THAT(complaint(path), HasSubstr("labels are whole numbers"));
  write(path, mha_header("MET_UCHAR") + std::string(16, '\0'));
  EXPECT_THAT(complaint(path), HasSubstr("holds no bubble"));
  write(path, mha_header("MET_CHAR") + std::string(16, '\xff'));
  EXPECT_THAT(complaint(path), HasSubstr("has the label -1"));
  write(folder.path() / "a.png", voxels);
  EXPECT_THAT(complaint(folder.path() / "a.png"), HasSubstr("the ending must be"));
}

}  // namespace
}  // namespace spume::io
