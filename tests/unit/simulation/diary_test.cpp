#include "spume/simulation/diary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "spume/base/error.hpp"
#include "spume/io/pvd_series.hpp"
#include "spume/io/vtk_films.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/simulation/diary_files.hpp"
#include "spume/simulation/diary_rows.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace spume::simulation {
namespace {

using testing::ScratchFolder;
using testing::text_of;

constexpr double radius = 1e-3;
constexpr double eta = 5e-6, lambda = 1e-9;

parallel::Communicator world() {
  return parallel::Communicator::world();
}

Case small_case() {
  Case run_case;
  run_case.box = {{-3e-3, -3e-3, -3e-3}, {3e-3, 3e-3, 3e-3}, {8, 8, 8}};
  return run_case;
}

/// A double bubble with uniform films, in a box of 8 × 8 × 8 cells.
struct Fixture {
  ScratchFolder folder;
  Case run_case = small_case();
  grid::Grid grid{world(), run_case.box};
  state::Foam foam{grid};
  mesh::Topology topology;

  Fixture() {
    foam.films = shapes::double_bubble(radius, 12);
    topology = mesh::build_topology(foam.films);
    const double volume = 9 * std::numbers::pi / 8 * std::pow(radius, 3);
    foam.phases.target_volume = {0, volume, volume};
    foam.liquid.lamella_volume = mesh::film_dof_areas(foam.films, topology);
    for (double& v : foam.liquid.lamella_volume) v *= 2 * eta;
    foam.liquid.border_volume = mesh::border_dof_lengths(foam.films, topology);
    for (double& v : foam.liquid.border_volume) v *= lambda;
  }

  /// The text of a file, the same on all ranks.
  std::string text(const std::string& name) const {
    world().barrier();
    return text_of(folder.path() / name);
  }
  /// Rows of a table as names and numbers.
  std::vector<std::vector<std::string>> table(const std::string& name) const {
    std::istringstream file(text(name));
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(file, line);) {
      auto& row = rows.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    }
    return rows;
  }
};

double number(const std::string& text) {
  return std::stod(text);
}

TEST(Diary, FilesStartWithTheColumnsOfTheManual) {
  const Fixture f;
  const Diary diary(world(), f.folder.path(), f.run_case, {}, false);
  EXPECT_EQ(f.text("history.csv"),
            "step,stage,time_s,dt_s,film_area_m2,kinetic_energy_J,lamella_liquid_m3,border_liquid_m3,liquid_"
            "error_rel,"
            "min_half_thickness_m,bubbles,lamellae,borders,junctions,max_speed_m_s,max_volume_error_rel,"
            "correction_J,limited_by\n");
  EXPECT_EQ(f.text("bubbles.csv"),
            "time_s,bubble,volume_m3,target_volume_m3,area_m2,pressure_Pa,x_m,y_m,z_m,extent_x_m,extent_y_m,"
            "extent_z_m,"
            "faces\n");
  EXPECT_EQ(f.text("lamellae.csv"),
            "time_s,lamella,phase_a,phase_b,area_m2,liquid_m3,min_half_thickness_m,mean_curvature_1_m\n");
  EXPECT_EQ(f.text("borders.csv"),
            "time_s,border,phase_a,phase_b,phase_c,length_m,liquid_m3,min_area_m2,max_area_m2\n");
  EXPECT_EQ(f.text("events.csv"), "time_s,event,detail\n");
}

TEST(Diary, ReadmeExplainsEveryColumnOfEveryTable) {
  const Fixture f;
  const Diary diary(world(), f.folder.path(), f.run_case, {}, false);
  const std::string readme = f.text("README.txt");
  for (const auto columns :
       {history_columns(), bubble_columns(), lamella_columns(), border_columns(), event_columns()})
    for (const auto& column : columns)
      EXPECT_NE(readme.find("    " + std::string(column.name) + " "), std::string::npos) << column.name;
  EXPECT_NE(readme.find("half_thickness_m"), std::string::npos);
}

TEST(Diary, HistoryTellsOfFilmsAndLiquid) {
  Fixture f;
  Diary diary(world(), f.folder.path(), f.run_case, {}, false);
  f.foam.time = 0.125;
  diary.record_step(f.foam, f.topology,
                    {.step = 3, .stage = Stage::Drain, .dt = 0.5, .kinetic_energy = 2, .max_speed = 4});
  // Liquid that left the films as spray is not lost; then a thousandth of what the borders hold is.
  f.foam.liquid.sprayed = 0.5 * f.foam.liquid.border_volume[0];
  f.foam.liquid.border_volume[0] *= 0.5;
  diary.record_step(f.foam, f.topology, {.step = 4, .min_half_thickness = 1e-7});
  const double total = f.foam.liquid.total() + f.foam.liquid.sprayed;
  const double lost = 1e-3 * f.foam.liquid.border_volume[1];
  f.foam.liquid.border_volume[1] -= lost;
  diary.record_step(f.foam, f.topology, {.step = 5});

  const auto rows = f.table("history.csv");
  ASSERT_EQ(rows.size(), 4u);
  const auto& row = rows[1];
  EXPECT_EQ(row[0], "3");
  EXPECT_EQ(row[1], "drain");
  EXPECT_EQ(row[2], "0.125");
  EXPECT_EQ(row[3], "0.5");
  // The flat triangles of this mesh have 0.11 % less area than the spheres.
  EXPECT_NEAR(number(row[4]), 27 * std::numbers::pi / 4 * radius * radius, 0.002 * number(row[4]));
  EXPECT_EQ(row[5], "2");
  EXPECT_NEAR(number(row[6]), 2 * eta * number(row[4]), 1e-12 * number(row[6]));  // round-off of sums
  EXPECT_NEAR(number(row[7]), lambda * std::sqrt(3.0) * std::numbers::pi * radius, 0.001 * number(row[7]));
  EXPECT_EQ(number(row[8]), 0);
  EXPECT_NEAR(number(row[9]), eta, 1e-12 * eta);
  EXPECT_EQ((std::vector<std::string>(row.begin() + 10, row.begin() + 15)),
            (std::vector<std::string>{"2", "3", "1", "0", "4"}));
  EXPECT_GT(number(row[15]), 0);  // volumes within the triangles, a little less than within the spheres
  EXPECT_LT(number(row[15]), 0.01);

  EXPECT_NEAR(number(rows[2][8]), 0, 1e-15);
  EXPECT_EQ(number(rows[2][9]), 1e-7);
  EXPECT_NEAR(number(rows[3][8]), -lost / total, 1e-3 * lost / total);
}

TEST(Diary, SliversDoNotCountAsTheThinnestPoint) {
  Fixture f;
  const auto area = mesh::film_dof_areas(f.foam.films, f.topology);
  const int dof = 7, v = f.topology.film_dof[dof].vertex;
  ASSERT_EQ(f.topology.vertex_kind[v], mesh::VertexKind::Film);
  f.foam.liquid.lamella_volume[dof] = 2 * area[dof] * 1e-8;
  const int lamella = f.topology.film_dof[dof].lamella;
  EXPECT_NEAR(min_half_thickness(f.foam, f.topology)[lamella], 1e-8, 1e-20);
  // The star of the vertex shrinks to a thousandth of its area: its value does not count any more.
  for (int s = f.topology.star_offset[v]; s < f.topology.star_offset[v + 1]; ++s)
    for (int w : f.foam.films.triangle[f.topology.star_triangle[s]].vertex)
      f.foam.films.position[w] =
          f.foam.films.position[v] + 0.03 * (f.foam.films.position[w] - f.foam.films.position[v]);
  f.foam.liquid.lamella_volume[dof] = 2 * mesh::film_dof_areas(f.foam.films, f.topology)[dof] * 1e-8;
  EXPECT_GT(min_half_thickness(f.foam, f.topology)[lamella], 1e-7);
}

TEST(Diary, FrameTellsOfBubblesLamellaeAndBorders) {
  Fixture f;
  f.foam.phases.target_volume.push_back(0);  // a bubble that is no more
  Diary diary(world(), f.folder.path(), f.run_case, {}, false);
  diary.record_frame(f.foam, f.topology, {0, 60, 61, 0});

  const auto bubbles = f.table("bubbles.csv");
  ASSERT_EQ(bubbles.size(), 3u);
  const double volume = 9 * std::numbers::pi / 8 * std::pow(radius, 3);
  for (int p : {1, 2}) {
    const auto& row = bubbles[p];
    EXPECT_EQ(number(row[1]), p);
    EXPECT_NEAR(number(row[2]), volume, 0.004 * volume);  // flat triangles: 0.21 % less
    EXPECT_EQ(number(row[3]), volume);
    EXPECT_EQ(number(row[5]), 59 + p);
    // A sphere of radius r around −r/2 without its cap beyond x = 0: its centre of volume is at −5r/8.
    EXPECT_NEAR(number(row[6]), (p == 1 ? -1 : 1) * 0.625 * radius, 0.001 * radius);
    EXPECT_NEAR(number(row[7]), 0, 1e-3 * radius);
    EXPECT_NEAR(number(row[9]), 1.5 * radius, 1e-3 * radius);  // no vertex need be at the top of the sphere
    EXPECT_EQ(row[12], "2");
  }
  const auto lamellae = f.table("lamellae.csv");
  ASSERT_EQ(lamellae.size(), 4u);
  for (std::size_t l = 1; l < 4; ++l) {
    const bool is_septum = lamellae[l][2] == "1";
    EXPECT_NEAR(number(lamellae[l][5]), 2 * eta * number(lamellae[l][4]), 1e-12 * number(lamellae[l][5]));
    EXPECT_NEAR(number(lamellae[l][6]), eta, 1e-12 * eta);
    // Outer films are spheres, curved towards the bubble, phase_b. Measured at this resolution: off
    // by 1.4e-5.
    EXPECT_NEAR(number(lamellae[l][7]), is_septum ? 0 : 2 / radius, 1e-4 / radius);
  }
  const auto borders = f.table("borders.csv");
  ASSERT_EQ(borders.size(), 2u);
  EXPECT_EQ((std::vector<std::string>(borders[1].begin() + 1, borders[1].begin() + 5)),
            (std::vector<std::string>{"0", "0", "1", "2"}));
  EXPECT_NEAR(number(borders[1][7]), lambda, 1e-12 * lambda);
  EXPECT_NEAR(number(borders[1][8]), lambda, 1e-12 * lambda);

  if (world().is_root()) {
    const auto frames = io::read_pvd(f.folder.path() / "films.pvd");
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].file, "films/films_000000.vtp");
    EXPECT_EQ(io::read_films(f.folder.path() / frames[0].file).triangle.size(), f.foam.films.triangle.size());
    EXPECT_FALSE(std::filesystem::exists(f.folder.path() / "gas.pvd"));
  }
}

TEST(Diary, GasFramesComeOnlyWhereTheCaseAsksForThem) {
  Fixture f;
  f.run_case.output.gas = true;
  Diary diary(world(), f.folder.path(), f.run_case, {}, false);
  diary.record_frame(f.foam, f.topology, {0, 60, 60});
  EXPECT_EQ(diary.mark().gas_frames, 1);
  world().barrier();
  EXPECT_TRUE(std::filesystem::exists(f.folder.path() / "gas" / "gas_000000.vti"));
  const std::string file = f.text("gas/gas_000000.vti");
  for (const char* name : {"velocity", "pressure", "phase", "distance"})
    EXPECT_NE(file.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
}

/// What a diary writes from step `first` on: two steps with an event and a frame each.
void live(Diary& diary, Fixture& f, int first) {
  for (int step = first; step < first + 2; ++step) {
    f.foam.time = 0.1 * step;
    diary.record_step(f.foam, f.topology, {.step = step, .dt = 0.1});
    diary.record_event({f.foam.time, "T1", "at step " + std::to_string(step)});
    diary.record_frame(f.foam, f.topology, {0, 60, 60});
  }
}

TEST(Diary, ResumedRunWritesTheSameFilesAsOneThatWasNotInterrupted) {
  Fixture f;
  f.run_case.output.gas = true;
  const std::vector<std::string> files{
      "history.csv", "bubbles.csv", "lamellae.csv",           "borders.csv",       "events.csv",
      "films.pvd",   "gas.pvd",     "films/films_000003.vtp", "gas/gas_000003.vti"};
  std::vector<std::string> uninterrupted;
  {
    Diary diary(world(), f.folder.path(), f.run_case, {}, false);
    live(diary, f, 0);
    live(diary, f, 2);
    for (const auto& file : files) uninterrupted.push_back(f.text(file));
  }
  DiaryMark mark;
  {
    Diary diary(world(), f.folder.path(), f.run_case, {}, false);
    EXPECT_FALSE(std::filesystem::exists(f.folder.path() / "films/films_000003.vtp"));  // of the run before
    live(diary, f, 0);
    mark = diary.mark();
    live(diary, f, 5);  // written after the checkpoint, then killed
    diary.record_step(f.foam, f.topology, {.step = 7});
  }
  Diary diary(world(), f.folder.path(), f.run_case, mark, true);
  EXPECT_FALSE(std::filesystem::exists(f.folder.path() / "films/films_000002.vtp"));
  live(diary, f, 2);
  for (std::size_t n = 0; n < files.size(); ++n) EXPECT_EQ(f.text(files[n]), uninterrupted[n]) << files[n];
  EXPECT_EQ(diary.mark().history_rows, 4);
  EXPECT_EQ(diary.mark().frames, 4);
}

TEST(Diary, MissingFileOfAResumedRunIsAnErrorOnAllRanks) {
  Fixture f;
  DiaryMark mark;
  {
    Diary diary(world(), f.folder.path(), f.run_case, {}, false);
    live(diary, f, 0);
    mark = diary.mark();
  }
  world().on_root([&] { std::filesystem::remove(f.folder.path() / "lamellae.csv"); });
  EXPECT_THROW(Diary(world(), f.folder.path(), f.run_case, mark, true), InputError);
}

}  // namespace
}  // namespace spume::simulation
