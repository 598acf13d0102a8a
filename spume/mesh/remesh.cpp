#include "spume/mesh/remesh.hpp"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "spume/base/contract.hpp"
#include "spume/mesh/collapse.hpp"
#include "spume/mesh/flip.hpp"
#include "spume/mesh/merge.hpp"
#include "spume/mesh/parts.hpp"
#include "spume/mesh/smooth.hpp"
#include "spume/mesh/split.hpp"
#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {
namespace {

constexpr int largest_number_of_rounds = 4;  // of split, collapse, flip, smooth
constexpr int reach_of_seam = 3;             // edges to both sides of a cut
constexpr int largest_number_of_split_passes =
    24;  // halving from the size of the foam to a film's resolution

void split_until_short(WorkingMesh& work, const TargetLength& target, const Projection& project,
                       const RemeshParameters& parameters, RemeshReport& report) {
  for (int pass = 0; pass < largest_number_of_split_passes; ++pass) {
    const int n_split = split_long_edges(work, target, project, parameters.split_above);
    if (n_split == 0) return;
    report.n_split += n_split;
    report.n_flipped += flip_edges(work);
  }
}

/// What has been drawn together may let edges beside it collapse.
void merge_and_collapse(WorkingMesh& work, const TargetLength& target, const RemeshParameters& parameters,
                        RemeshReport& report) {
  const int n_merged = merge_tiny_features(work, target, parameters);
  report.n_merged += n_merged;
  if (n_merged > 0) report.n_collapsed += collapse_short_edges(work, target, parameters);
}

int count_tiny_edges(const FilmMesh& mesh, const TargetLength& target, double tiny) {
  const std::vector<double> target_length = targets_at_vertices(mesh, target);
  std::vector<std::pair<int, int>> edges;
  for (const FilmTriangle& t : mesh.triangle)
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t.vertex[c], t.vertex[(c + 1) % 3]);
      const double limit = tiny * 0.5 * (target_length[low] + target_length[high]);
      if (norm_squared(mesh.edge(low, high)) < limit * limit) edges.emplace_back(low, high);
    }
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  return static_cast<int>(repeated.begin() - edges.begin());
}

/// Adds what was done to a part.
void add(const RemeshReport& part, RemeshReport& report) {
  report.n_collapsed += part.n_collapsed;
  report.n_split += part.n_split;
  report.n_flipped += part.n_flipped;
  report.n_merged += part.n_merged;
}

RemeshReport remesh_part(FilmMesh& mesh, int n_cut, const TargetLength& target, const Projection& project,
                         const RemeshParameters& parameters) {
  const bool splits = parameters.split_above > 0;
  RemeshReport report;
  WorkingMesh work(mesh, n_cut);
  for (int round = 0; round < (splits ? largest_number_of_rounds : 1); ++round) {
    const int n_before = report.n_split + report.n_collapsed;
    if (splits) split_until_short(work, target, project, parameters, report);
    report.n_collapsed += collapse_short_edges(work, target, parameters);
    if (parameters.merge_below > 0) merge_and_collapse(work, target, parameters, report);
    EdgeFlipper flipper(work);
    report.n_flipped += flipper.run();
    if (round > 0 && report.n_split + report.n_collapsed == n_before) break;
    for (int sweep = 0; sweep < parameters.smoothing_sweeps; ++sweep) {
      smooth(work, project);
      report.n_flipped += flipper.run();
    }
  }
  return report;
}

}  // namespace

RemeshReport remesh(FilmMesh& mesh, const TargetLength& target, const Projection& project,
                    const RemeshParameters& parameters, const parallel::Communicator& ranks) {
  expects(static_cast<bool>(target) && static_cast<bool>(project),
          "remeshing needs target lengths and a projection");
  expects(parameters.split_above <= 0 || parameters.split_above >= 2 * parameters.collapse_below,
          "halves of a split edge must not be short enough to collapse");

  RemeshReport report, own;
  const auto work = [&](FilmMesh& part, int n_cut) {
    add(remesh_part(part, n_cut, target, project, parameters), own);
  };
  expects(parameters.least_slab > 0, "slabs have vertices");
  const int n_slabs =
      static_cast<int>(std::bit_floor(static_cast<unsigned>(mesh.n_vertices() / parameters.least_slab)));
  if (n_slabs < 2) {
    work(mesh, 0);
    report = own;
  } else {
    const Slabs slabs(mesh, n_slabs);
    const int n_cut = work_in_parts(mesh, slabs.of_triangles(mesh), n_slabs, work, ranks);
    work_in_parts(mesh, seams_of_triangles(mesh, slabs, n_cut, reach_of_seam), n_slabs - 1, work, ranks);
    std::vector<int> of_rank;
    for (const RemeshReport& of_one : ranks.joined(std::vector{own}, of_rank)) add(of_one, report);
  }
  report.n_left_short = count_tiny_edges(mesh, target, parameters.tiny);
  return report;
}

}  // namespace spume::mesh
