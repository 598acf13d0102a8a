#include "spume/mesh/remesh.hpp"

#include "spume/base/contract.hpp"
#include "spume/mesh/collapse.hpp"
#include "spume/mesh/flip.hpp"
#include "spume/mesh/merge.hpp"
#include "spume/mesh/smooth.hpp"
#include "spume/mesh/split.hpp"
#include "spume/mesh/working_mesh.hpp"

namespace spume::mesh {
namespace {

constexpr int largest_number_of_rounds = 4;  // of split, collapse, flip, smooth
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
  int n_tiny = 0;
  for (const MeshEdge& e : build_edges(mesh).edge)
    n_tiny += norm(mesh.edge(e.low, e.high)) < tiny * 0.5 * (target_length[e.low] + target_length[e.high]);
  return n_tiny;
}

}  // namespace

RemeshReport remesh(FilmMesh& mesh, const TargetLength& target, const Projection& project,
                    const RemeshParameters& parameters, const parallel::Communicator& ranks) {
  expects(static_cast<bool>(target) && static_cast<bool>(project),
          "remeshing needs target lengths and a projection");
  const bool splits = parameters.split_above > 0;
  expects(!splits || parameters.split_above >= 2 * parameters.collapse_below,
          "halves of a split edge must not be short enough to collapse");

  RemeshReport report;
  WorkingMesh work(mesh, ranks);
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
  report.n_left_short = count_tiny_edges(mesh, target, parameters.tiny);
  return report;
}

}  // namespace spume::mesh
