#include "spume/io/vtk_films.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <limits>
#include <stdexcept>

#include "spume/io/durable.hpp"
#include "spume/io/film_arrays.hpp"

namespace spume::io {

namespace {

template <class Array>
vtkNew<Array> named(const Column& column) {
  vtkNew<Array> array;
  array->SetName(column.name.data());
  return array;
}

/// Film points, then border points.
void add_points(const state::FilmFrame& frame, vtkPolyData& data) {
  constexpr double not_here = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto eta = named<vtkDoubleArray>(arrays::half_thickness);
  const auto lambda = named<vtkDoubleArray>(arrays::border_area);
  for (std::size_t p = 0; p < frame.film_point.size(); ++p) {
    const Vec3& x = frame.film_point[p];
    points->InsertNextPoint(x.x, x.y, x.z);
    eta->InsertNextValue(frame.half_thickness[p]);
    lambda->InsertNextValue(not_here);
  }
  for (std::size_t p = 0; p < frame.border_point.size(); ++p) {
    const Vec3& x = frame.border_point[p];
    points->InsertNextPoint(x.x, x.y, x.z);
    eta->InsertNextValue(not_here);
    lambda->InsertNextValue(frame.border_area[p]);
  }
  data.SetPoints(points);
  data.GetPointData()->AddArray(eta);
  data.GetPointData()->AddArray(lambda);
}

/// Poly-lines, then triangles: VTK counts the cells of poly-data in this order.
void add_cells(const state::FilmFrame& frame, vtkPolyData& data) {
  vtkNew<vtkCellArray> lines, triangles;
  const auto lamella = named<vtkIntArray>(arrays::lamella), border = named<vtkIntArray>(arrays::border);
  const auto phase_a = named<vtkIntArray>(arrays::phase_a), phase_b = named<vtkIntArray>(arrays::phase_b);
  const auto add_row = [&](int of_lamella, int a, int b, int of_border) {
    lamella->InsertNextValue(of_lamella);
    phase_a->InsertNextValue(a);
    phase_b->InsertNextValue(b);
    border->InsertNextValue(of_border);
  };
  const auto first_border_point = static_cast<vtkIdType>(frame.film_point.size());
  for (std::size_t b = 0; b < frame.border_line.size(); ++b) {
    lines->InsertNextCell(static_cast<int>(frame.border_line[b].size()));
    for (int p : frame.border_line[b]) lines->InsertCellPoint(first_border_point + p);
    add_row(-1, -1, -1, static_cast<int>(b));
  }
  for (const auto& triangle : frame.triangle) {
    triangles->InsertNextCell(3);
    for (int p : triangle.point) triangles->InsertCellPoint(p);
    add_row(triangle.lamella, triangle.phase_a, triangle.phase_b, -1);
  }
  data.SetLines(lines);
  data.SetPolys(triangles);
  for (vtkIntArray* array : {lamella.Get(), phase_a.Get(), phase_b.Get(), border.Get()})
    data.GetCellData()->AddArray(array);
}

}  // namespace

std::span<const Column> film_arrays() {
  return arrays::all;
}

void write_films(const state::FilmFrame& frame, const std::filesystem::path& path) {
  vtkNew<vtkPolyData> data;
  add_points(frame, *data);
  add_cells(frame, *data);
  const auto time = named<vtkDoubleArray>(arrays::time);
  time->InsertNextValue(frame.time);
  data->GetFieldData()->AddArray(time);

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->WriteToOutputStringOn();  // so that errors of the disk are ours to report
  if (writer->Write() == 0) throw std::runtime_error(fmt::format("{}: VTK cannot write it", path.string()));
  write_text_durably(path, writer->GetOutputString());
}

}  // namespace spume::io
