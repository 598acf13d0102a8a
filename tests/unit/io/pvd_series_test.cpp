#include "spume/io/pvd_series.hpp"

#include <gtest/gtest.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include "spume/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace spume::io {
namespace {

using testing::ScratchFolder;

TEST(PvdSeries, IsValidXmlWithOneDataSetAFrame) {
  const ScratchFolder folder;
  const auto path = folder.path() / "films.pvd";
  PvdSeries series(path);
  series.append(0, "films/films_000000.vtp");
  series.append(1.0 / 3, "films/films_000001.vtp");

  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  ASSERT_NE(root, nullptr);
  EXPECT_STREQ(root->GetName(), "VTKFile");
  EXPECT_STREQ(root->GetAttribute("type"), "Collection");
  auto* collection = root->FindNestedElementWithName("Collection");
  ASSERT_NE(collection, nullptr);
  ASSERT_EQ(collection->GetNumberOfNestedElements(), 2);
  auto* second = collection->GetNestedElement(1);
  double time = 0;
  ASSERT_EQ(second->GetScalarAttribute("timestep", time), 1);
  EXPECT_DOUBLE_EQ(time, 1.0 / 3);
  EXPECT_STREQ(second->GetAttribute("file"), "films/films_000001.vtp");
}

TEST(PvdSeries, IsCutBackToTheFramesThatCount) {
  const ScratchFolder folder;
  const auto path = folder.path() / "films.pvd";
  {
    PvdSeries series(path);
    for (const char* name : {"f0", "f1", "f2", "f3"})
      series.append(0.1 * static_cast<double>(series.frames().size()), name);
  }
  PvdSeries series(path, 2);
  EXPECT_EQ(read_pvd(path).size(), 2u);
  series.append(0.7, "g");
  const auto frames = read_pvd(path);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].time, 0.1);
  EXPECT_EQ(frames[1].file, "f1");
  EXPECT_EQ(frames[2].time, 0.7);
  EXPECT_THROW(PvdSeries(path, 4), InputError);
}

TEST(PvdSeries, RefusesWhatIsNotASeries) {
  const ScratchFolder folder;
  EXPECT_THROW(read_pvd(folder.path() / "missing.pvd"), InputError);
  std::ofstream(folder.path() / "bad.pvd") << "<DataSet file=\"a\"/>\n";
  EXPECT_THROW(read_pvd(folder.path() / "bad.pvd"), InputError);
}

}  // namespace
}  // namespace spume::io
