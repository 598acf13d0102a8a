#include "spume/io/vtk_gas.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include <stdexcept>

#include "spume/base/contract.hpp"
#include "spume/io/durable.hpp"

namespace spume::io {

namespace {

constexpr std::array<Column, 4> columns{{
    {"velocity", "cell data: velocity of the gas [m/s]"},
    {"pressure",
     "cell data: pressure of the gas [Pa] without the part that is constant in each bubble, which is "
     "pressure_Pa of bubbles.csv"},
    {"phase", "cell data: the phase that holds the centre of the cell; 0 is the outside"},
    {"distance", "cell data: distance from the centre of the cell to the nearest film [m]"},
}};
constexpr Column velocity = columns[0], pressure = columns[1], phase = columns[2], distance = columns[3];

template <class Array, class Value>
void add(vtkImageData& image, const Column& column, const std::vector<Value>& values) {
  if (values.empty()) return;
  expects(static_cast<vtkIdType>(values.size()) == image.GetNumberOfCells(),
          "one value for each cell of the box");
  vtkNew<Array> array;
  array->SetName(column.name.data());
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  for (std::size_t c = 0; c < values.size(); ++c)
    array->SetValue(static_cast<vtkIdType>(c), static_cast<typename Array::ValueType>(values[c]));
  image.GetCellData()->AddArray(array);
}

void add_velocity(vtkImageData& image, const std::array<std::vector<double>, 3>& u) {
  if (u[0].empty()) return;
  vtkNew<vtkFloatArray> array;
  array->SetName(velocity.name.data());
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(image.GetNumberOfCells());
  for (int axis = 0; axis < 3; ++axis) {
    expects(static_cast<vtkIdType>(u[axis].size()) == image.GetNumberOfCells(),
            "one value for each cell of the box");
    for (std::size_t c = 0; c < u[axis].size(); ++c)
      array->SetTypedComponent(static_cast<vtkIdType>(c), axis, static_cast<float>(u[axis][c]));
  }
  image.GetCellData()->AddArray(array);
}

}  // namespace

std::span<const Column> gas_arrays() {
  return columns;
}

void write_gas(const GasFrame& frame, const grid::Box& box, const std::filesystem::path& path) {
  vtkNew<vtkImageData> image;
  const double h = box.spacing();
  image->SetDimensions(box.cells.i + 1, box.cells.j + 1, box.cells.k + 1);
  image->SetOrigin(box.lower.x, box.lower.y, box.lower.z);
  image->SetSpacing(h, h, h);
  add_velocity(*image, frame.velocity);
  add<vtkFloatArray>(*image, pressure, frame.pressure);
  add<vtkIntArray>(*image, phase, frame.phase);
  add<vtkFloatArray>(*image, distance, frame.distance);
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(frame.time);
  image->GetFieldData()->AddArray(time);

  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->SetDataModeToAppended();
  writer->WriteToOutputStringOn();  // so that errors of the disk are ours to report
  if (writer->Write() == 0) throw std::runtime_error(fmt::format("{}: VTK cannot write it", path.string()));
  write_text_durably(path, writer->GetOutputString());
}

}  // namespace spume::io
