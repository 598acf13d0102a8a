#include "spume/interface/carry.hpp"

#include <vector>

namespace spume::interface {

void carry(mesh::FilmMesh& films, const grid::VectorField& velocity, const grid::KernelCoupling& kernel,
           double dt) {
  std::vector<Vec3> u;
  kernel.sample(velocity, films.position, u);
  std::vector<Vec3> middle(films.position);
  for (std::size_t v = 0; v < middle.size(); ++v) middle[v] += 0.5 * dt * u[v];
  kernel.sample(velocity, middle, u);
  for (std::size_t v = 0; v < middle.size(); ++v) films.position[v] += dt * u[v];
}

}  // namespace spume::interface
