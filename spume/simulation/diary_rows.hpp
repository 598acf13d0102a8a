#pragma once

#include <vector>

#include "spume/io/csv_table.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/simulation/diary.hpp"
#include "spume/state/foam.hpp"

namespace spume::simulation {

/// What the rows of the diary say about a foam. Each row follows the columns of diary_files.hpp.
using Row = std::vector<io::CsvValue>;

/// `initial_liquid`: in films, borders and spray at the first row of the run [m³].
Row history_row(const state::Foam& foam, const mesh::Topology& topology, const StepRecord& record,
                double initial_liquid);
/// One row a living bubble; `pressure` of each phase [Pa].
std::vector<Row> bubble_rows(const state::Foam& foam, const mesh::Topology& topology,
                             const std::vector<double>& pressure);
std::vector<Row> lamella_rows(const state::Foam& foam, const mesh::Topology& topology);
std::vector<Row> border_rows(const state::Foam& foam, const mesh::Topology& topology);

/// Smallest half-thickness of each lamella [m]. Film dofs with less than 5 % of the mean dof area of their
/// lamella do not count: slivers of a mesh have volumes that round-off and transfer decide.
std::vector<double> min_half_thickness(const state::Foam& foam, const mesh::Topology& topology);

/// Mean of κ = k₁ + k₂ over each lamella [1/m], from the area gradient −∂A/∂x_v = κ A_v n_v at the vertices
/// inside it; n from phase_a into phase_b, so κ > 0 where phase_b bulges out. NaN where a lamella has no
/// vertex inside.
std::vector<double> mean_curvatures(const mesh::FilmMesh& films, const mesh::Topology& topology);

/// Centre of volume and lengths of the bounding box of each phase [m], indexed by phase; of no meaning for
/// the outside.
struct PhaseShape {
  Vec3 centroid, extent;
};
std::vector<PhaseShape> phase_shapes(const mesh::FilmMesh& films, int n_phases);

}  // namespace spume::simulation
