#include "spume/interface/clearance.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace spume::interface {

namespace {

std::string problem_at(const grid::Grid& grid, const mesh::FilmMesh& films, const std::array<bool, 3>& counts,
                       const char* what) {
  const double clearance = 4 * grid.h();
  for (const Vec3& x : films.position)
    for (int d = 0; d < 3; ++d)
      if (!std::isfinite(x[d]) || (counts[d] && !(x[d] >= grid.box().lower[d] + clearance &&
                                                  x[d] <= grid.box().upper[d] - clearance)))
        return fmt::format(
            "a film at ({:.6g}, {:.6g}, {:.6g}) m is within four cells ({:.3g} m) of {}; films need a larger "
            "box",
            x.x, x.y, x.z, clearance, what);
  return {};
}

}  // namespace

std::string clearance_problem(const grid::Grid& grid, const mesh::FilmMesh& films) {
  const auto& periodic = films.domain.periodic;
  return problem_at(grid, films, {!periodic[0], !periodic[1], !periodic[2]}, "a wall");
}

std::string edge_problem(const grid::Grid& grid, const mesh::FilmMesh& films) {
  return problem_at(grid, films, {true, true, true}, "the edge of the box");
}

}  // namespace spume::interface
