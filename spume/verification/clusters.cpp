#include "spume/verification/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spume/mesh/measure.hpp"

namespace spume::verification {

namespace {

/// Points that two, three, … unit spheres or their power planes have in common, by projections in turn: onto
/// the planes x·(c_i − c_j) = const of pairs of bubbles and onto the sphere of a bubble that meets the
/// outside. The planes cut the sphere at 60° and each other at 60°, so a few dozen turns reach round-off.
Vec3 on_cluster(const std::vector<Vec3>& centre, double radius, const mesh::PhaseSet& phases, Vec3 x) {
  std::vector<mesh::Phase> bubbles;
  for (mesh::Phase p : phases)
    if (p > 0) bubbles.push_back(p);
  for (int turn = 0; turn < 200; ++turn) {
    for (std::size_t b = 1; b < bubbles.size(); ++b) {
      const Vec3 &ca = centre[bubbles[b - 1] - 1], &cb = centre[bubbles[b] - 1];
      const Vec3 n = normalized(cb - ca);
      x -= dot(x - 0.5 * (ca + cb), n) * n;
    }
    if (phases.contains(0)) {
      const Vec3& c = centre[bubbles[0] - 1];
      x = c + radius * normalized(x - c);
    }
  }
  return x;
}

}  // namespace

Vec3 cluster_centre(const Units& units) {
  return units.radius * Vec3{0.0131, 0.0227, -0.0172};
}

simulation::Case with_cluster(simulation::Case of, const Units& units, int n, double spread, double size) {
  for (const Vec3& c : equal_cluster_centres(n)) {
    const double r = size * units.radius;
    of.foam.bubble.push_back({cluster_centre(units) + spread * units.radius * c, {r, r, r}});
  }
  return of;
}

void put_onto_exact_cluster(FoamRun& run, double radius) {
  auto& films = run.foam().films;
  const auto& topology = run.topology();
  std::vector<Vec3> centre;
  for (const auto& bubble : run.run_case().foam.bubble) centre.push_back(bubble.center);
  for (int v = 0; v < films.n_vertices(); ++v)
    films.position[v] = on_cluster(centre, radius, topology.vertex_phases[v], films.position[v]);
  run.accept_volumes();
  run.forget_motion();
}

ClusterErrors errors_of_cluster(FoamRun& run, int n) {
  auto& foam = run.foam();
  const EqualCluster exact = equal_cluster(n);
  const auto& topology = run.topology();
  const auto& target = foam.phases.target_volume;
  const double mean_volume = std::accumulate(target.begin() + 1, target.end(), 0.0) / n;
  const double radius = exact.radius_for(mean_volume);

  ClusterErrors errors{};
  errors.area = mesh::film_area(foam.films) / (exact.area * radius * radius) - 1;
  const auto length = mesh::border_lengths(foam.films, topology);
  if (exact.border_length() > 0)
    errors.border_length =
        std::accumulate(length.begin(), length.end(), 0.0) / (exact.border_length() * radius) - 1;
  double inner = 0;
  for (int b = 0; b < topology.n_borders(); ++b)
    if (topology.border[b].phases[0] > 0) inner += length[b];
  if (exact.n_inner_borders > 0)
    errors.inner_border = inner / (exact.n_inner_borders * exact.inner_border * radius) - 1;

  const auto pressure = bubble_pressures(run);
  const auto volume = mesh::phase_volumes(foam.films, foam.phases.count());
  const double expected = 4 * run.run_case().materials.film.surface_tension / radius;
  for (mesh::Phase p = 1; p <= n; ++p) {
    const double error = pressure[p] / expected - 1;
    if (std::abs(error) > std::abs(errors.pressure)) errors.pressure = error;
    errors.volume = std::max(errors.volume, std::abs(volume[p] / target[p] - 1));
  }
  errors.virial = virial_error(run);
  if (n == 4) {
    Vec3 middle;
    for (mesh::Phase p = 1; p <= n; ++p) middle += run.run_case().foam.bubble[p - 1].center / n;
    for (int junction : topology.junction)
      if (!topology.vertex_phases[junction].contains(0))
        errors.centre = norm(foam.films.position[junction] - middle);
  }
  return errors;
}

}  // namespace spume::verification
