#pragma once

#include <array>
#include <vector>

#include "spume/grid/field.hpp"
#include "spume/mesh/film_mesh.hpp"

namespace spume::verification {

/// A material point of a film with the area around it.
struct FilmTracer {
  mesh::Phase phase_a, phase_b;   ///< of its film
  Vec3 position;                  ///< [m]
  std::array<Vec3, 2> direction;  ///< orthonormal, in the plane of the material surface
  double area;                    ///< that it stood for at the start [m²]
  double stretch = 1;             ///< dA/dA0 since the start
};

/// Material points on films that go with the velocity that carries them, and know how far the film around
/// each has been stretched: dη/dt = −η ∇_s·u means η = η0 / stretch. They see neither the film mesh nor its
/// reconstructions nor what restores volumes, so they are a check of all these.
class FilmTracers {
 public:
  /// One in the middle of every triangle. `separation` [m] is that of the points by which stretching is
  /// measured, small against the cells.
  FilmTracers(const mesh::FilmMesh& films, double separation);

  /// Mid-point rule over dt [s], as the films are carried. Collective.
  void move(const grid::VectorField& velocity_on_faces, double dt);

  const std::vector<FilmTracer>& all() const { return tracers_; }
  std::vector<FilmTracer>& all() { return tracers_; }

 private:
  double separation_;
  std::vector<FilmTracer> tracers_;
};

}  // namespace spume::verification
