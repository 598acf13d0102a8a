#include "spume/verification/film_tracers.hpp"

#include "spume/grid/kernel_coupling.hpp"
#include "spume/mesh/locate.hpp"

namespace spume::verification {

FilmTracers::FilmTracers(const mesh::FilmMesh& films) {
  constexpr int n = 4;  // parts of each side; a triangle is cut into n² alike
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto corner = films.corners(t);
    const Film film{films.triangle[t].phase_a, films.triangle[t].phase_b,
                    mesh::triangle_area(films, t) / (n * n)};
    const auto add = [&](double i, double j) {
      position_.push_back(corner[0] + i / n * (corner[1] - corner[0]) + j / n * (corner[2] - corner[0]));
      film_.push_back(film);
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j) {
        add(i + 1.0 / 3, j + 1.0 / 3);
        if (i + j < n - 1) add(i + 2.0 / 3, j + 2.0 / 3);
      }
  }
}

void FilmTracers::move(const grid::VectorField& velocity_on_faces, double dt) {
  const grid::KernelCoupling kernel{.placement = grid::Placement::Faces};
  kernel.sample(velocity_on_faces, position_, velocity_);
  middle_ = position_;
  for (std::size_t p = 0; p < middle_.size(); ++p) middle_[p] += 0.5 * dt * velocity_[p];
  kernel.sample(velocity_on_faces, middle_, velocity_);
  for (std::size_t p = 0; p < middle_.size(); ++p) position_[p] += dt * velocity_[p];
}

std::vector<double> FilmTracers::area_at_dofs(const transport::LiquidMesh& mesh, double bin_size) const {
  const mesh::TriangleLocator locator(mesh.films, bin_size);
  std::vector<double> area(mesh.topology.film_dof.size(), 0.0);
  for (std::size_t p = 0; p < position_.size(); ++p) {
    const Film& film = film_[p];
    const auto found = locator.closest(position_[p], 2 * bin_size, [&](int t) {
      const auto& triangle = mesh.films.triangle[t];
      return triangle.phase_a == film.phase_a && triangle.phase_b == film.phase_b;
    });
    if (found.triangle < 0) continue;
    for (int c = 0; c < 3; ++c)
      area[mesh.topology.corner_dof[found.triangle][c]] += found.weight[c] * film.area;
  }
  return area;
}

}  // namespace spume::verification
