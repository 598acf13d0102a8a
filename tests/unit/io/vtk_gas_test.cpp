#include "spume/io/vtk_gas.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>

#include "tests/support/scratch_folder.hpp"

namespace spume::io {
namespace {

constexpr grid::Box box{{-1e-3, 0, 2e-3}, {3e-3, 2e-3, 8e-3}, {4, 2, 6}};

TEST(VtkGas, PutsEachCellWhereItIs) {
  const testing::ScratchFolder folder;
  GasFrame frame;
  frame.time = 0.5;
  for (int c = 0; c < 48; ++c) {
    for (int axis = 0; axis < 3; ++axis) frame.velocity[axis].push_back(100 * axis + c);
    frame.phase.push_back(c % 5);
  }
  write_gas(frame, box, folder.path() / "gas.vti");

  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName((folder.path() / "gas.vti").c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  ASSERT_EQ(image->GetNumberOfCells(), 48);
  auto* velocity = image->GetCellData()->GetArray("velocity");
  auto* phase = image->GetCellData()->GetArray("phase");
  ASSERT_TRUE(velocity && phase);
  EXPECT_EQ(image->GetCellData()->GetArray("pressure"), nullptr);  // was not given
  EXPECT_EQ(image->GetCellData()->GetArray("distance"), nullptr);

  double centre[3] = {0.5e-3, 1.5e-3, 4.5e-3};  // of cell (1, 1, 2)
  int index[3];
  double local[3];
  ASSERT_EQ(image->ComputeStructuredCoordinates(centre, index, local), 1);
  const vtkIdType cell = image->ComputeCellId(index);
  constexpr int expected = (2 * 2 + 1) * 4 + 1;
  EXPECT_EQ(velocity->GetComponent(cell, 0), expected);
  EXPECT_EQ(velocity->GetComponent(cell, 2), 200 + expected);
  EXPECT_EQ(phase->GetTuple1(cell), expected % 5);
}

TEST(VtkGas, RefusesAnArrayOfAnotherLength) {
  GasFrame frame;
  frame.pressure.assign(47, 0.0);
  EXPECT_THROW(write_gas(frame, box, "unused.vti"), std::logic_error);
}

}  // namespace
}  // namespace spume::io
