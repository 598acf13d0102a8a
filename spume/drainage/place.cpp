#include "spume/drainage/place.hpp"

#include <sstream>

#include "spume/base/error.hpp"

namespace spume::drainage {
namespace {

const char* kind_text(mesh::VertexKind kind) {
  switch (kind) {
    case mesh::VertexKind::Junction:
      return "a junction";
    case mesh::VertexKind::Border:
      return "a Plateau border";
    case mesh::VertexKind::Film:
      break;
  }
  return "the inside of a film";
}

}  // namespace

std::string place_text(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x.x << ", " << x.y << ", " << x.z << ") m";
  return text.str();
}

std::string describe_film_dof(const state::FilmNetwork& network, int film_dof, double eta) {
  const auto [vertex, lamella] = network.topology.film_dof[film_dof];
  const auto& phases = network.topology.lamella[lamella];
  std::ostringstream text;
  text << "half-thickness " << eta << " m in the film between phases " << phases.phase_a << " and "
       << phases.phase_b << ", at " << kind_text(network.topology.vertex_kind[vertex]) << ", "
       << place_text(network.mesh.position[vertex]);
  return text.str();
}

std::string describe_border_vertex(const state::FilmNetwork& network, int vertex, double lambda) {
  std::ostringstream text;
  text << "cross-section " << lambda << " m² at " << kind_text(network.topology.vertex_kind[vertex]) << ", "
       << place_text(network.mesh.position[vertex]);
  return text.str();
}

void throw_at(const std::string& what, const Vec3& x) {
  throw NumericalError(what + " at " + place_text(x));
}

}  // namespace spume::drainage
