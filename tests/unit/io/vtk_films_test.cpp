#include "spume/io/vtk_films.hpp"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "spume/base/error.hpp"
#include "spume/io/film_frame.hpp"
#include "spume/mesh/measure.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace spume::io {
namespace {

using testing::ScratchFolder;

/// Four bubbles of radius 1 mm; every dof has a volume of its own.
struct Sample {
  mesh::FilmMesh films = shapes::four_bubbles(1e-3, 4);
  mesh::Topology topology = mesh::build_topology(films);
  state::FilmLiquid liquid;
  Sample() {
    for (std::size_t d = 0; d < topology.film_dof.size(); ++d)
      liquid.lamella_volume.push_back(1e-14 * (1 + 0.01 * d));
    for (std::size_t d = 0; d < topology.border_dof.size(); ++d)
      liquid.border_volume.push_back(1e-13 * (1 + 0.01 * d));
  }
  state::FilmFrame frame(double time) const { return film_frame(films, topology, liquid, time); }
};

void expect_equal(const state::FilmFrame& a, const state::FilmFrame& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.film_point, b.film_point);
  EXPECT_EQ(a.half_thickness, b.half_thickness);
  EXPECT_EQ(a.border_point, b.border_point);
  EXPECT_EQ(a.border_area, b.border_area);
  EXPECT_EQ(a.border_line, b.border_line);
  ASSERT_EQ(a.triangle.size(), b.triangle.size());
  for (std::size_t t = 0; t < a.triangle.size(); ++t) {
    EXPECT_EQ(a.triangle[t].point, b.triangle[t].point);
    EXPECT_EQ(a.triangle[t].lamella, b.triangle[t].lamella);
    EXPECT_EQ(a.triangle[t].phase_a, b.triangle[t].phase_a);
    EXPECT_EQ(a.triangle[t].phase_b, b.triangle[t].phase_b);
  }
}

TEST(VtkFilms, FrameKeepsTheLiquidOfEveryDof) {
  const Sample sample;
  const auto frame = sample.frame(0);
  const auto area = mesh::film_dof_areas(sample.films, sample.topology);
  const auto length = mesh::border_dof_lengths(sample.films, sample.topology);
  ASSERT_EQ(frame.half_thickness.size(), area.size());
  ASSERT_EQ(frame.border_area.size(), length.size());
  double in_films = 0, in_borders = 0;
  for (std::size_t d = 0; d < area.size(); ++d) in_films += 2 * frame.half_thickness[d] * area[d];
  for (std::size_t d = 0; d < length.size(); ++d) in_borders += frame.border_area[d] * length[d];
  // One division and one multiplication a dof: round-off.
  EXPECT_NEAR(in_films, sample.liquid.in_lamellae(), 1e-14 * in_films);
  EXPECT_NEAR(in_borders, sample.liquid.in_borders(), 1e-14 * in_borders);
}

TEST(VtkFilms, ReadsBackBitForBit) {
  const ScratchFolder folder;
  const auto frame = Sample().frame(1.0 / 3);
  write_films(frame, folder.path() / "films.vtp");
  expect_equal(read_films(folder.path() / "films.vtp"), frame);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "films.vtp.new"));
}

TEST(VtkFilms, ClosedLamellaWithoutBordersAndEmptyFoamReadBack) {
  const ScratchFolder folder;
  const auto films = shapes::sphere({1e-3, 0, 0}, 1e-3, 2, 1);
  const auto topology = mesh::build_topology(films);
  state::FilmLiquid liquid;
  liquid.lamella_volume.assign(topology.film_dof.size(), 1e-14);
  const auto sphere = film_frame(films, topology, liquid, 2);
  write_films(sphere, folder.path() / "sphere.vtp");
  expect_equal(read_films(folder.path() / "sphere.vtp"), sphere);

  state::FilmFrame empty;
  empty.time = 3;
  write_films(empty, folder.path() / "empty.vtp");
  expect_equal(read_films(folder.path() / "empty.vtp"), empty);
}

TEST(VtkFilms, HoldsTheArraysOfTheOutputFolderForVtksOwnReader) {
  const ScratchFolder folder;
  const Sample sample;
  write_films(sample.frame(0.25), folder.path() / "films.vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder.path() / "films.vtp").c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfLines(), 10);
  ASSERT_EQ(data->GetNumberOfPolys(), sample.films.n_triangles());
  const auto n_film_points = static_cast<vtkIdType>(sample.topology.film_dof.size());

  auto* eta = data->GetPointData()->GetArray("half_thickness_m");
  auto* lambda = data->GetPointData()->GetArray("border_area_m2");
  ASSERT_TRUE(eta && lambda);
  ASSERT_EQ(eta->GetNumberOfTuples(), data->GetNumberOfPoints());
  ASSERT_EQ(lambda->GetNumberOfTuples(), data->GetNumberOfPoints());
  for (vtkIdType p = 0; p < data->GetNumberOfPoints(); ++p) {
    EXPECT_EQ(std::isnan(eta->GetTuple1(p)), p >= n_film_points);
    EXPECT_EQ(std::isnan(lambda->GetTuple1(p)), p < n_film_points);
  }
  for (const char* name : {"lamella", "phase_a", "phase_b", "border"}) {
    auto* array = data->GetCellData()->GetArray(name);
    ASSERT_TRUE(array) << name;
    ASSERT_EQ(array->GetNumberOfTuples(), data->GetNumberOfCells()) << name;
    for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
      const bool is_line = data->GetCell(c)->GetCellDimension() == 1;
      EXPECT_EQ(array->GetTuple1(c) >= 0, is_line == (std::string(name) == "border"))
          << name << " of cell " << c;
    }
  }
  EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.25);
}

TEST(VtkFilms, PointsOfLamellaeAreSeparateAtBorders) {
  const Sample sample;
  const auto frame = sample.frame(0);
  std::vector<int> lamella_of_point(frame.film_point.size(), -1);
  for (const auto& triangle : frame.triangle)
    for (int p : triangle.point) {
      EXPECT_TRUE(lamella_of_point[p] == -1 || lamella_of_point[p] == triangle.lamella);
      lamella_of_point[p] = triangle.lamella;
    }
  EXPECT_GT(frame.film_point.size(), sample.films.position.size());
}

TEST(VtkFilms, RefusesOtherFilesByName) {
  const ScratchFolder folder;
  const auto path = folder.path() / "no.vtp";
  EXPECT_THROW(read_films(path), InputError);
  std::ofstream(path) << "no XML";
  EXPECT_THROW(read_films(path), InputError);
  write_films(Sample().frame(0), path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THROW(read_films(path), InputError);
}

/// Two triangles in the (x, y) plane on points 0 to 3, and a poly-line on points 4 and 5.
struct TextFile {
  std::string verts = "", line = "4 5", triangles = "0 1 2 0 2 3", strips = "";
  std::string phase_b = "1 2", time = "0.5";

  static std::string cells(const std::string& name, const std::string& points, int size) {
    const auto n = points.empty() ? 0 : (1 + std::ranges::count(points, ' ')) / size;
    std::string offsets;
    for (int c = 1; c <= n; ++c) offsets += std::to_string(c * size) + " ";
    return "<" + name + "><DataArray type='Int64' Name='connectivity' format='ascii'>" + points +
           "</DataArray><DataArray type='Int64' Name='offsets' format='ascii'>" + offsets + "</DataArray></" +
           name + ">\n";
  }
  static std::string array(const std::string& name, const std::string& values) {
    return "<DataArray type='Float64' Name='" + name + "' format='ascii'>" + values + "</DataArray>\n";
  }
  /// Cell data of the vertices, lines and strips there are, with those of the triangles in their place.
  std::string on_cells(const std::string& of_triangles) const {
    return (verts.empty() ? "" : "-7 ") + std::string(line.empty() ? "" : "-1 ") + of_triangles +
           (strips.empty() ? "" : " -9");
  }
  std::filesystem::path written_to(const std::filesystem::path& path) const {
    const std::string n_times = time.empty() ? "0" : "1";
    std::ofstream(path) << "<VTKFile type='PolyData' version='1.0' header_type='UInt64'><PolyData>\n"
                        << "<FieldData><DataArray type='Float64' Name='TimeValue' NumberOfTuples='" << n_times
                        << "' format='ascii'>" << time << "</DataArray></FieldData>\n"
                        << "<Piece NumberOfPoints='6' NumberOfVerts='" << !verts.empty()
                        << "' NumberOfLines='" << !line.empty() << "' NumberOfStrips='" << !strips.empty()
                        << "' NumberOfPolys='2'>\n<PointData>" << array("half_thickness_m", "1 2 3 4 0 0")
                        << array("border_area_m2", "0 0 0 0 5 6") << "</PointData>\n<CellData>"
                        << array("lamella", on_cells("0 0")) << array("phase_a", on_cells("0 0"))
                        << array("phase_b", on_cells(phase_b)) << "</CellData>\n<Points>"
                        << "<DataArray type='Float64' NumberOfComponents='3' format='ascii'>"
                        << "0 0 0 1 0 0 1 1 0 0 1 0 0 0 0 1 0 0</DataArray></Points>\n"
                        << cells("Verts", verts, 1) << cells("Lines", line, 2) << cells("Strips", strips, 4)
                        << cells("Polys", triangles, 3) << "</Piece></PolyData></VTKFile>\n";
    return path;
  }
};

std::string complaint(const TextFile& file) {
  const ScratchFolder folder;
  try {
    read_films(file.written_to(folder.path() / "text.vtp"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(VtkFilms, ReadsTextAndPassesOverCellsThatAreVertices) {
  const ScratchFolder folder;
  for (const std::string verts : {"", "3"}) {
    const auto frame = read_films(TextFile{.verts = verts}.written_to(folder.path() / "text.vtp"));
    ASSERT_EQ(frame.triangle.size(), 2u);
    EXPECT_EQ(frame.triangle[0].phase_b, 1);
    EXPECT_EQ(frame.triangle[1].phase_b, 2);
    EXPECT_EQ(frame.time, 0.5);
    EXPECT_EQ(frame.border_line, (std::vector<std::vector<int>>{{0, 1}}));
  }
  EXPECT_EQ(read_films(TextFile{.time = ""}.written_to(folder.path() / "text.vtp")).time, 0);
}

TEST(VtkFilms, RefusesCellsThatUsePointsThatAreNotThere) {
  for (const std::string point : {"999999999", "-5", "6"}) {
    const std::string expected = "a cell uses point " + point + "; there are 6";
    EXPECT_NE(complaint({.triangles = "0 1 2 0 2 " + point}).find(expected), std::string::npos);
    EXPECT_NE(complaint({.line = "4 " + point}).find(expected), std::string::npos);
  }
}

TEST(VtkFilms, RefusesStripsAndPhasesBeyondAllNumbers) {
  EXPECT_NE(complaint({.strips = "0 1 2 3"}).find("strips"), std::string::npos);
  for (const std::string phase : {"1e300", "-3e9"})
    EXPECT_NE(complaint({.phase_b = "1 " + phase}).find("'phase_b' of triangle 1 is"), std::string::npos)
        << complaint({.phase_b = "1 " + phase});
}

TEST(VtkFilms, SaysWhenTheFolderIsNotThere) {
  EXPECT_THROW(write_films(Sample().frame(0), "/nowhere/films.vtp"), std::runtime_error);
}

}  // namespace
}  // namespace spume::io
