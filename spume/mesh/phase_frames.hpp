#pragma once

#include <array>
#include <vector>

#include "spume/mesh/film_mesh.hpp"

namespace spume::mesh {

/// Where each phase lies in a periodic box. A phase whose films leave part of a direction free is bounded
/// there, and can be looked at in one piece: by the images of its films nearest to its middle. A phase that
/// goes all the way through (a layer, a tunnel) is not. In directions that are not periodic every phase is
/// bounded.
class PhaseFrames {
 public:
  PhaseFrames(const FilmMesh& mesh, int n_phases);

  bool bounded(Phase p, int axis) const { return frame_[p].bounded[axis]; }
  /// The range that the films of p take up [m], in images around the middle; the whole box in directions
  /// without bound. Empty (lower > upper) for a phase without films.
  const Vec3& lower(Phase p) const { return frame_[p].lower; }
  const Vec3& upper(Phase p) const { return frame_[p].upper; }
  const Vec3& middle(Phase p) const { return frame_[p].middle; }

  /// Corners of a triangle of phase p, moved together to the image that belongs to p's films [m].
  std::array<Vec3, 3> place(Phase p, const std::array<Vec3, 3>& corner) const;
  /// The part of a triangle, or of a point of a surface, in the volume of p by the divergence theorem over
  /// the bounded directions:
  ///   ∫ x_d n_d dA, mean over d, x from the middle of p [m³]. `centroid` [m] by any image; `area` is the
  /// area vector out of p [m²].
  double cone(Phase p, const Vec3& centroid, const Vec3& area) const {
    if (!as_stored_) return cone_of_images(p, centroid, area);
    return (1.0 / 3) * dot(centroid - frame_[p].middle, area);
  }
  /// The volume of p from the sum of its cones [m³]. A layer's cones give its volume but for a multiple of
  /// that of the box. Not a number for a phase without bound in any direction.
  double volume(Phase p, double cones) const;

 private:
  /// Finds the frames without images; false where some are needed.
  bool take_as_stored(const FilmMesh& mesh);
  void take_images(const FilmMesh& mesh);
  double cone_of_images(Phase p, const Vec3& centroid, const Vec3& area) const;

  struct Frame {
    Vec3 lower, upper, middle;
    std::array<bool, 3> bounded{true, true, true};
    int n_bounded = 3;
  };

  Domain domain_;
  std::vector<Frame> frame_;
  bool as_stored_ = false;  ///< no film goes over the edge of a periodic box
};

/// Whether the foam is a body with the outside around it: it has films to the outside, and these leave a part
/// of every periodic direction free. Only then is there an outer pressure, and the virial identity holds:
/// Σ_i (p_i − p_0) V_i = (2/3) 2σA.
bool stands_free(const FilmMesh& mesh, int n_phases);

}  // namespace spume::mesh
