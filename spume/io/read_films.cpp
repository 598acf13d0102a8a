#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "spume/base/error.hpp"
#include "spume/io/film_arrays.hpp"
#include "spume/io/vtk_films.hpp"

namespace spume::io {

namespace {

/// The array of this name, with one number for each of `n_tuples` or more.
vtkDataArray& array_of(vtkFieldData* fields, const Column& column, vtkIdType n_tuples,
                       const std::string& path) {
  vtkDataArray* array = fields->GetArray(column.name.data());
  if (array == nullptr)
    throw InputError(fmt::format("{}: not a films file of spume: it has no array '{}'", path, column.name));
  if (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() < n_tuples)
    throw InputError(fmt::format("{}: the array '{}' needs one number for each of {} points or cells", path,
                                 column.name, n_tuples));
  return *array;
}

double time_of(vtkPolyData& data, const std::string& path) {
  vtkDataArray& time = array_of(data.GetFieldData(), arrays::time, 0, path);
  return time.GetNumberOfTuples() > 0 ? time.GetTuple1(0) : 0;
}

/// VTK does not look whether the points that cells use are there.
void check_cells(vtkPolyData& data, const std::string& path) {
  if (data.GetStrips()->GetNumberOfCells() > 0)
    throw InputError(path + ": holds triangle strips; give single triangles");
  vtkNew<vtkIdList> points;
  for (vtkCellArray* cells : {data.GetLines(), data.GetPolys()})
    for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c) {
      cells->GetCellAtId(c, points);
      for (vtkIdType p = 0; p < points->GetNumberOfIds(); ++p)
        if (points->GetId(p) < 0 || points->GetId(p) >= data.GetNumberOfPoints())
          throw InputError(fmt::format("{}: a cell uses point {}; there are {}, from 0 on", path,
                                       points->GetId(p), data.GetNumberOfPoints()));
    }
}

Vec3 point_of(vtkPolyData& data, vtkIdType p) {
  std::array<double, 3> x;
  data.GetPoint(p, x.data());
  return {x[0], x[1], x[2]};
}

/// Film points come first; they are those with a half-thickness that some triangle uses, so their number is
/// one more than the largest index in a triangle.
vtkIdType count_film_points(vtkPolyData& data) {
  vtkIdType n = 0;
  vtkNew<vtkIdList> points;
  for (vtkIdType c = 0; c < data.GetPolys()->GetNumberOfCells(); ++c) {
    data.GetPolys()->GetCellAtId(c, points);
    for (vtkIdType p = 0; p < points->GetNumberOfIds(); ++p) n = std::max(n, points->GetId(p) + 1);
  }
  return n;
}

void read_points(vtkPolyData& data, vtkIdType n_film_points, const std::string& path,
                 state::FilmFrame& frame) {
  vtkDataArray& eta = array_of(data.GetPointData(), arrays::half_thickness, data.GetNumberOfPoints(), path);
  vtkDataArray& lambda = array_of(data.GetPointData(), arrays::border_area, data.GetNumberOfPoints(), path);
  for (vtkIdType p = 0; p < data.GetNumberOfPoints(); ++p) {
    if (p < n_film_points) {
      frame.film_point.push_back(point_of(data, p));
      frame.half_thickness.push_back(eta.GetTuple1(p));
    } else {
      frame.border_point.push_back(point_of(data, p));
      frame.border_area.push_back(lambda.GetTuple1(p));
    }
  }
}

void read_cells(vtkPolyData& data, vtkIdType n_film_points, const std::string& path,
                state::FilmFrame& frame) {
  vtkNew<vtkIdList> points;
  const vtkIdType n_lines = data.GetLines()->GetNumberOfCells();
  for (vtkIdType c = 0; c < n_lines; ++c) {
    data.GetLines()->GetCellAtId(c, points);
    auto& line = frame.border_line.emplace_back();
    for (vtkIdType p = 0; p < points->GetNumberOfIds(); ++p) {
      if (points->GetId(p) < n_film_points) throw InputError(path + ": a poly-line uses points of a film");
      line.push_back(static_cast<int>(points->GetId(p) - n_film_points));
    }
  }
  const auto cell_array = [&](const Column& column) -> vtkDataArray& {
    return array_of(data.GetCellData(), column, data.GetNumberOfCells(), path);
  };
  vtkDataArray &lamella = cell_array(arrays::lamella), &phase_a = cell_array(arrays::phase_a),
               &phase_b = cell_array(arrays::phase_b);
  // Cell data have the order vertices, lines, polygons, whatever the order in the file.
  const vtkIdType first_triangle = data.GetVerts()->GetNumberOfCells() + n_lines;
  const auto value = [&](vtkDataArray& array, vtkIdType triangle) {
    const double number = array.GetTuple1(first_triangle + triangle);
    if (!(std::abs(number) <= std::numeric_limits<int>::max()))
      throw InputError(fmt::format("{}: '{}' of triangle {} is {}", path, array.GetName(), triangle, number));
    return static_cast<int>(number);
  };
  for (vtkIdType c = 0; c < data.GetPolys()->GetNumberOfCells(); ++c) {
    data.GetPolys()->GetCellAtId(c, points);
    if (points->GetNumberOfIds() != 3) throw InputError(path + ": holds polygons that are not triangles");
    const auto at = [&](int corner) { return static_cast<int>(points->GetId(corner)); };
    frame.triangle.push_back(
        {{at(0), at(1), at(2)}, value(lamella, c), value(phase_a, c), value(phase_b, c)});
  }
}

}  // namespace

state::FilmFrame read_films(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("{}: no such file", path.string()));
  // Errors of VTK are counted here; without this it prints them.
  bool failed = false;
  vtkNew<vtkCallbackCommand> on_error;
  on_error->SetClientData(&failed);
  on_error->SetCallback(
      [](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetReaderErrorObserver(on_error);
  reader->SetParserErrorObserver(on_error);
  reader->AddObserver("ErrorEvent", on_error);
  if (reader->CanReadFile(path.c_str()) == 0)
    throw InputError(fmt::format("{}: not a VTK poly-data file (.vtp)", path.string()));
  reader->SetFileName(path.c_str());
  reader->Update();
  if (failed || reader->GetErrorCode() != 0) throw InputError(fmt::format("{}: damaged", path.string()));

  vtkPolyData& data = *reader->GetOutput();
  state::FilmFrame frame;
  frame.time = time_of(data, path.string());
  check_cells(data, path.string());
  const vtkIdType n_film_points = count_film_points(data);
  read_points(data, n_film_points, path.string(), frame);
  read_cells(data, n_film_points, path.string(), frame);
  return frame;
}

}  // namespace spume::io
