#include "spume/simulation/diary_files.hpp"

#include <fmt/format.h>

#include <array>

#include "spume/io/vtk_films.hpp"
#include "spume/io/vtk_gas.hpp"

namespace spume::simulation {

namespace {

using io::Column;

constexpr std::array<Column, 18> history{{
    {"step", "number of the step since the start of the run"},
    {"stage", "rearrange, drain or rupture"},
    {"time_s", "simulated time after the step"},
    {"dt_s", "length of the step"},
    {"film_area_m2", "area of all films, every film once"},
    {"kinetic_energy_J", "of the gas"},
    {"lamella_liquid_m3", "liquid in the lamellae"},
    {"border_liquid_m3", "liquid in the Plateau borders"},
    {"liquid_error_rel",
     "(liquid in lamellae and borders + sprayed so far - liquid at the first row) / liquid at the first row"},
    {"min_half_thickness_m", "thinnest point of the lamellae (half-thickness) that counts"},
    {"bubbles", "number of bubbles; the outside is not one"},
    {"lamellae", "number of lamellae (connected films between two phases)"},
    {"borders", "number of Plateau borders"},
    {"junctions", "number of junctions, where four borders meet"},
    {"max_speed_m_s", "largest speed of the gas"},
    {"max_volume_error_rel", "largest |volume - target volume| / target volume of a bubble"},
    {"correction_J",
     "change of the film energy 2 sigma A in this step by what is no motion: restored volumes, "
     "reconstruction"},
    {"limited_by", "what set dt_s: capillary waves, advection, error, ..."},
}};

constexpr std::array<Column, 13> bubbles{{
    {"time_s", "simulated time"},
    {"bubble", "number of the bubble; a number is never used again"},
    {"volume_m3", "volume enclosed by its films"},
    {"target_volume_m3", "volume that it is held at"},
    {"area_m2", "area of its films"},
    {"pressure_Pa", "relative to the outside (phase 0); without an outside, to the mean over the volume"},
    {"x_m", "centre of volume"},
    {"y_m", "centre of volume"},
    {"z_m", "centre of volume"},
    {"extent_x_m", "length of its bounding box along x"},
    {"extent_y_m", "length of its bounding box along y"},
    {"extent_z_m", "length of its bounding box along z"},
    {"faces", "number of lamellae around it"},
}};

constexpr std::array<Column, 8> lamellae{{
    {"time_s", "simulated time"},
    {"lamella", "number of the lamella at this time; the same in the films file of this time"},
    {"phase_a", "phase on one side; 0 is the outside"},
    {"phase_b", "phase on the other side, the larger number"},
    {"area_m2", "area of the lamella"},
    {"liquid_m3", "liquid in it"},
    {"min_half_thickness_m", "smallest half-thickness on it"},
    {"mean_curvature_1_m",
     "mean of k1 + k2 over its inside, positive where phase_b bulges out; nan where it has no inside vertex"},
}};

constexpr std::array<Column, 9> borders{{
    {"time_s", "simulated time"},
    {"border", "number of the Plateau border at this time; the same in the films file of this time"},
    {"phase_a", "the three phases that meet there, in increasing order"},
    {"phase_b", "see phase_a"},
    {"phase_c", "see phase_a"},
    {"length_m", "length of the border"},
    {"liquid_m3", "liquid in it"},
    {"min_area_m2", "smallest cross-section along it"},
    {"max_area_m2", "largest cross-section along it"},
}};

constexpr std::array<Column, 3> events{{
    {"time_s", "simulated time"},
    {"event", "rupture, T1, bubble lost, equilibrium reached, ..."},
    {"detail", "in words and numbers"},
}};

std::string explain(const std::string& file, const std::string& what, std::span<const Column> columns) {
  std::string text = fmt::format("{}\n  {}\n", file, what);
  for (const Column& column : columns) text += fmt::format("    {:<24}{}\n", column.name, column.meaning);
  return text + '\n';
}

}  // namespace

std::span<const Column> history_columns() {
  return history;
}
std::span<const Column> bubble_columns() {
  return bubbles;
}
std::span<const Column> lamella_columns() {
  return lamellae;
}
std::span<const Column> border_columns() {
  return borders;
}
std::span<const Column> event_columns() {
  return events;
}

std::string explain_output() {
  return "What the files of this folder hold. All quantities are in SI units.\n\n" +
         explain("case.toml", "The case as it was run: version, every key, every default.", {}) +
         explain("history.csv", "One row a step.", history) +
         explain("bubbles.csv", "One row a bubble at every frame.", bubbles) +
         explain("lamellae.csv", "One row a lamella at every frame.", lamellae) +
         explain("borders.csv", "One row a Plateau border at every frame.", borders) +
         explain("events.csv", "One row for everything that happened to the foam.", events) +
         explain("films.pvd, films/films_NNNNNN.vtp",
                 "The films at every frame, for ParaView: lamellae as triangles, Plateau borders as "
                 "poly-lines. Points are\n"
                 "  separate where lamellae meet. Entries without meaning hold nan or -1.",
                 io::film_arrays()) +
         explain("gas.pvd, gas/gas_NNNNNN.vti",
                 "The gas at every frame, where the case asks for it (output.gas).", io::gas_arrays()) +
         explain("checkpoint/", "The complete state, from which 'spume resume' goes on.", {}) +
         explain("log.txt", "What the program said.", {}) +
         explain("summary.txt", "How the run ended; there when it is finished.", {});
}

}  // namespace spume::simulation
