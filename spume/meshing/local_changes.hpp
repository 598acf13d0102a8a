#pragma once

#include <span>

#include "spume/mesh/remesh.hpp"
#include "spume/meshing/star_mesh.hpp"

namespace spume::meshing {

/// Changes of a mesh around one triangle, each made only if it lowers the worst badness (star_mesh.hpp) of
/// the triangles it changes. A side `corner` of a triangle runs from that corner to the next.
class LocalChanges {
 public:
  /// `target`: wanted edge lengths at vertices [m].
  LocalChanges(StarMesh& star_mesh, const mesh::Projection& project, std::span<const double> target)
      : m_(star_mesh), project_(project), target_(target) {}

  /// Flips the side of a triangle inside a film, unless it closes off the corner of the film at a junction.
  bool flip_if_better(int triangle, int corner);
  /// Moves a vertex within its film or along its border to the best place found by a pattern search.
  bool relocate(int v);
  /// Draws v into its neighbour w, which stays where it is.
  bool collapse_if_better(int v, int w);
  /// Puts the film vertex opposite to a side onto the border that the side is part of.
  bool absorb_if_better(int triangle, int corner);
  /// Flips the side if it is the only edge that runs from a junction into this corner of a film, so that one
  /// triangle fills the corner. Its other end is drawn into a neighbour, if need be; not if an angle
  /// below 24 degrees would come of it.
  bool fill_corner(int triangle, int corner);

 private:
  struct Hinge {
    int left, right;         ///< triangles
    int a, b, apex, beyond;  ///< the side runs from a to b in `left`, whose third corner is the apex
  };
  bool hinge_at(int triangle, int corner, Hinge& hinge) const;
  bool may_flip(const Hinge& hinge, double& before, double& after) const;
  bool is_filled_corner(const Hinge& hinge) const;
  bool fills_well(const Hinge& hinge, const Vec3& place, int gone) const;
  void collapse(int v, int w);
  void flip(const Hinge& hinge);
  bool keeps_topology(int v, int w, int n_shared) const;
  bool keeps_lengths(int v, int w) const;
  void drop_dead(int v);

  StarMesh& m_;
  const mesh::Projection& project_;
  std::span<const double> target_;
};

}  // namespace spume::meshing
