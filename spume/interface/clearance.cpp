#include "spume/interface/clearance.hpp"

#include <fmt/format.h>

#include <cmath>

namespace spume::interface {

std::string clearance_problem(const grid::Grid& grid, const mesh::FilmMesh& films) {
  const double clearance = 4 * grid.h();
  for (const Vec3& x : films.position)
    for (int d = 0; d < 3; ++d)
      if (!std::isfinite(x[d]) || (!films.domain.periodic[d] && !(x[d] >= grid.box().lower[d] + clearance &&
                                                                  x[d] <= grid.box().upper[d] - clearance)))
        return fmt::format(
            "a film at ({:.6g}, {:.6g}, {:.6g}) m is within four cells ({:.3g} m) of a wall; films need a "
            "larger "
            "box",
            x.x, x.y, x.z, clearance);
  return {};
}

}  // namespace spume::interface
