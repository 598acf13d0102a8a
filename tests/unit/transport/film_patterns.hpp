#pragma once

#include <cmath>
#include <functional>

#include "spume/mesh/measure.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/transport/transfer.hpp"

/// Liquid with a given thickness on a mesh, for tests.
namespace spume::patterns {

/// A film mesh with its topology.
struct Foam {
  mesh::FilmMesh films;
  mesh::Topology topology;

  explicit Foam(mesh::FilmMesh mesh) : films(std::move(mesh)), topology(mesh::build_topology(films)) {}
};

inline Vec3 rotated(const Vec3& x, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * x + s * cross(axis, x) + (1 - c) * dot(axis, x) * axis;
}

inline mesh::FilmMesh rotated(mesh::FilmMesh films, const Vec3& axis, double angle) {
  for (Vec3& x : films.position) x = rotated(x, axis, angle);
  return films;
}

using Function = std::function<double(const Vec3& x)>;

/// Half-thickness η(x) [m] on all lamellae and cross-section λ(x) [m²] on all borders.
inline state::FilmLiquid liquid_of(const Foam& foam, const Function& eta, const Function& lambda) {
  state::FilmLiquid liquid = transport::uniform_liquid(foam.films, foam.topology, 1, 1);
  for (std::size_t d = 0; d < liquid.lamella_volume.size(); ++d)
    liquid.lamella_volume[d] *= eta(foam.films.position[foam.topology.film_dof[d].vertex]);
  for (std::size_t d = 0; d < liquid.border_volume.size(); ++d)
    liquid.border_volume[d] *= lambda(foam.films.position[foam.topology.border_dof[d].vertex]);
  return liquid;
}

/// Volume held by one lamella [m³].
inline double held_by(const Foam& foam, const state::FilmLiquid& liquid, int lamella) {
  double sum = 0;
  for (std::size_t d = 0; d < liquid.lamella_volume.size(); ++d)
    if (foam.topology.film_dof[d].lamella == lamella) sum += liquid.lamella_volume[d];
  return sum;
}

inline int lamella_between(const Foam& foam, mesh::Phase a, mesh::Phase b) {
  for (int l = 0; l < foam.topology.n_lamellae(); ++l)
    if (foam.topology.lamella[l].phase_a == a && foam.topology.lamella[l].phase_b == b) return l;
  return -1;
}

/// η per film dof [m].
inline std::vector<double> half_thickness(const Foam& foam, const state::FilmLiquid& liquid) {
  std::vector<double> eta = mesh::film_dof_areas(foam.films, foam.topology);
  for (std::size_t d = 0; d < eta.size(); ++d) eta[d] = liquid.lamella_volume[d] / (2 * eta[d]);
  return eta;
}

}  // namespace spume::patterns
