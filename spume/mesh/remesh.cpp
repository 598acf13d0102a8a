#include "spume/mesh/remesh.hpp"

#include <algorithm>
#include <bit>
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
constexpr double few = 0.002;                // changes, to vertices, that are not worth another round
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
    if (round > 0 && report.n_split + report.n_collapsed - n_before <= few * work.mesh.n_vertices()) break;
    for (int sweep = 0; sweep < parameters.smoothing_sweeps; ++sweep) {
      smooth(work, project);
      report.n_flipped += flipper.run();
    }
  }
  return report;
}

/// Slabs so thick that the seams at both of their sides and the cuts within these fit in, with edges as long
/// as collapses may leave them.
Slabs slabs_to_remesh(const FilmMesh& mesh, const TargetLength& target, const RemeshParameters& parameters) {
  expects(parameters.least_slab > 0, "slabs have vertices");
  const int n_worthwhile = mesh.n_vertices() / parameters.least_slab;
  if (n_worthwhile < 2) return {mesh, 1, 0};
  const double longest_edge = parameters.no_edge_beyond * std::ranges::max(targets_at_vertices(mesh, target));
  return {mesh, static_cast<int>(std::bit_floor(static_cast<unsigned>(n_worthwhile))),
          (2 * reach_of_seam + 1) * longest_edge};
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
  // Before there are cuts, whose edges no slab could split: what it would split beside them is sliver by
  // sliver.
  if (parameters.split_above > 0) {
    WorkingMesh whole(mesh);
    split_until_short(whole, target, project, parameters, report);
  }
  const Slabs slabs = slabs_to_remesh(mesh, target, parameters);
  if (slabs.count() < 2) {
    work(mesh, 0);
    add(own, report);
  } else {
    const int n_cut = work_in_parts(mesh, slabs.of_triangles(mesh), slabs.count(), work, ranks);
    const Seams seams = seams_around_cuts(mesh, slabs, n_cut, reach_of_seam);
    work_in_parts(mesh, seams.of_triangle, seams.count, work, ranks);
    std::vector<int> of_rank;
    for (const RemeshReport& of_one : ranks.joined(std::vector{own}, of_rank)) add(of_one, report);
  }
  return report;
}

}  // namespace spume::mesh
