#pragma once

#include <functional>
#include <optional>

#include "spume/mesh/film_mesh.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::mesh {

/// Puts a point that belongs to the given phases back onto the surface (film), line (border) or point
/// (junction) where they meet; nothing when it cannot, and then the point stays.
using Projection = std::function<std::optional<Vec3>(const Vec3& position, const PhaseSet& phases)>;
/// Wanted edge length at a point [m].
using TargetLength = std::function<double(const Vec3& position)>;

/// Remeshing of a multi-film mesh: collapses, splits, flips and tangential smoothing that keep it conforming
/// and never change which lamellae, borders and junctions there are, apart from those smaller than
/// merge_below × target, which become a junction of more than four phases. Precedence junction > border >
/// film throughout. A mesh of 2 least_slab vertices or more is remeshed in slabs across its longest axis, 2,
/// 4, 8 … of them and none between two others thinner than seven edges of no_edge_beyond × the largest
/// target, each as if nothing were beyond its cuts, and then in seams around the cuts. Results depend on the
/// mesh alone, not on ranks. Target lengths between points are the mean of those at the ends of an edge.
/// Coarsening alone (split_above = 0) is collapse_short_edges, flip_edges and the sweeps of smooth, once;
/// refinement repeats split_long_edges and these until next to nothing is split or collapsed (two in a
/// thousand vertices), four times at most, and then a few edges may be longer than split_above × target. 1.4
/// is a good value of split_above: halves must not be short enough to collapse (split_above ≥ 2
/// collapse_below). Vertices on an edge of a single triangle, where a film ends at a wall, do not move and do
/// not disappear.
struct RemeshParameters {
  double collapse_below = 0.7;  ///< collapse edges shorter than this × target
  double no_edge_beyond = 1.8;  ///< a collapse may not make an edge longer than this × target
  double tiny = 0.25;      ///< below this × target an edge goes even if normals turn or edges grow to 2.2
  double merge_below = 0;  ///< × target: what shorter edges join becomes one vertex, see merge.hpp; 0: never
  double split_above = 0;  ///< split edges longer than this × target; 0: never
  int smoothing_sweeps = 3;  ///< tangential, each followed by projection and flips
  int least_slab = 49152;    ///< vertices of a slab that is worth its seam
};
struct RemeshReport {
  int n_collapsed = 0, n_split = 0, n_flipped = 0;
  int n_merged = 0;  ///< vertices drawn together with others: see merge.hpp

  /// Whether the triangles are others than before.
  bool changed() const { return n_collapsed + n_split + n_flipped + n_merged > 0; }
};

/// Remeshes with `target` lengths > 0 everywhere; breaks a contract (std::logic_error) otherwise. Vertices
/// and triangles are renumbered; the order of those that stay is kept but for slabs. Collective: the ranks,
/// which all hold the mesh, share the work; the result does not depend on their number. `project` must answer
/// alike on all of them.
RemeshReport remesh(FilmMesh& mesh, const TargetLength& target, const Projection& project,
                    const RemeshParameters& parameters,
                    const parallel::Communicator& ranks = parallel::Communicator::self());

}  // namespace spume::mesh
