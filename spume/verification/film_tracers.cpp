#include "spume/verification/film_tracers.hpp"

#include <cmath>

#include "spume/grid/kernel_coupling.hpp"

namespace spume::verification {

FilmTracers::FilmTracers(const mesh::FilmMesh& films, double separation) : separation_(separation) {
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto corner = films.corners(t);
    const Vec3 normal = mesh::doubled_area_normal(films, t);
    const double doubled = norm(normal);
    if (!(doubled > 0)) continue;
    const Vec3 along = normalized(corner[1] - corner[0]);
    tracers_.push_back({.phase_a = films.triangle[t].phase_a,
                        .phase_b = films.triangle[t].phase_b,
                        .position = (corner[0] + corner[1] + corner[2]) / 3,
                        .direction = {along, cross(normal / doubled, along)},
                        .area = 0.5 * doubled});
  }
}

void FilmTracers::move(const grid::VectorField& velocity_on_faces, double dt) {
  const grid::KernelCoupling kernel{.placement = grid::Placement::Faces};
  std::vector<Vec3> start, middle, u;
  for (const FilmTracer& tracer : tracers_)
    for (const Vec3& offset : {Vec3{}, tracer.direction[0], tracer.direction[1]})
      start.push_back(tracer.position + separation_ * offset);
  kernel.sample(velocity_on_faces, start, u);
  for (std::size_t p = 0; p < start.size(); ++p) middle.push_back(start[p] + 0.5 * dt * u[p]);
  kernel.sample(velocity_on_faces, middle, u);
  for (std::size_t n = 0; n < tracers_.size(); ++n) {
    FilmTracer& tracer = tracers_[n];
    tracer.position += dt * u[3 * n];
    // Differences of velocities, not of places: these would lose digits.
    const Vec3 a = tracer.direction[0] + dt / separation_ * (u[3 * n + 1] - u[3 * n]);
    const Vec3 b = tracer.direction[1] + dt / separation_ * (u[3 * n + 2] - u[3 * n]);
    const Vec3 normal = cross(a, b);
    tracer.stretch *= norm(normal);
    tracer.direction[0] = normalized(a);
    tracer.direction[1] = cross(normalized(normal), tracer.direction[0]);
  }
}

}  // namespace spume::verification
