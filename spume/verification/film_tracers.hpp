#pragma once

#include <vector>

#include "spume/grid/field.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/transport/liquid_mesh.hpp"

namespace spume::verification {

/// Material points on films that go with the velocity that carries them. Each keeps the film that it stood
/// for at the start: of a film that was uniform, η/η0 is the sum of these areas over the area on which the
/// points lie now. They see neither the film mesh nor its reconstructions, nor what restores volumes or
/// transfers liquid, and so check all of these.
class FilmTracers {
 public:
  /// Sixteen on every triangle.
  explicit FilmTracers(const mesh::FilmMesh& films);

  /// Mid-point rule over dt [s] in the velocity that moved the films. Collective.
  void move(const grid::VectorField& velocity_on_faces, double dt);

  /// The area at the start of the points near every film dof, each shared by the corners of the triangle of
  /// its film that is closest within two bins [m²].
  std::vector<double> area_at_dofs(const transport::LiquidMesh& mesh, double bin_size) const;

 private:
  struct Film {
    mesh::Phase phase_a, phase_b;
    double area;  ///< [m²]
  };
  std::vector<Vec3> position_;
  std::vector<Film> film_;
  std::vector<Vec3> middle_, velocity_;
};

}  // namespace spume::verification
