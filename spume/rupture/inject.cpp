#include "spume/rupture/inject.hpp"

#include <algorithm>

#include "spume/base/error.hpp"
#include "spume/mesh/locate.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::rupture {

namespace {

bool between(const mesh::FilmTriangle& triangle, const std::optional<mesh::Lamella>& films) {
  return !films || (triangle.phase_a == films->phase_a && triangle.phase_b == films->phase_b);
}

/// A mesh onto which balls collapse.
struct Target {
  const mesh::FilmMesh& films;
  const mesh::Topology& topology;
  mesh::TriangleLocator locator;
  std::vector<double> dof_area;
};

/// Film dofs around a ball with their shares.
struct Shares {
  std::vector<int> dof;
  std::vector<double> weight;
  double sum = 0;
};

Shares shares_within(const Target& target, const LiquidBall& ball, double radius) {
  Shares shares;
  for (int t : target.locator.near(ball.centre, radius))
    if (between(target.films.triangle[t], ball.films))
      for (int d : target.topology.corner_dof[t]) shares.dof.push_back(d);
  std::sort(shares.dof.begin(), shares.dof.end());
  shares.dof.erase(std::unique(shares.dof.begin(), shares.dof.end()), shares.dof.end());
  for (int d : shares.dof) {
    const Vec3& x = target.films.position[target.topology.film_dof[d].vertex];
    const double z =
        std::max(0.0, 1 - norm_squared(target.films.domain.step(ball.centre, x)) / (radius * radius));
    shares.weight.push_back(z * z * target.dof_area[d]);
    shares.sum += shares.weight.back();
  }
  return shares;
}

Shares shares_around(const Target& target, const LiquidBall& ball, double radius) {
  const double enough = 0.13 * radius * radius;
  constexpr int n_growths = 40;  // 1.5⁴⁰ ≈ 10⁷: beyond every film
  double reach = radius;
  for (int n = 0; n < n_growths; ++n, reach *= 1.5) {
    // A foam that has less film than enough altogether takes the liquid where it has any.
    Shares shares = shares_within(target, ball, reach);
    if (shares.sum > (n < 6 ? enough : 0)) return shares;
  }
  if (ball.films) return shares_around(target, {ball.centre, ball.volume, std::nullopt}, radius);
  throw NumericalError("no film is left to take the liquid of the ruptured films");
}

}  // namespace

double inject(std::span<const LiquidBall> balls, const mesh::FilmMesh& films, const mesh::Topology& topology,
              double radius, std::span<double> lamella_volume) {
  if (balls.empty()) return 0;
  const Target target{films, topology, mesh::TriangleLocator(films, radius),
                      mesh::film_dof_areas(films, topology)};
  double injected = 0;
  for (const LiquidBall& ball : balls) {
    const Shares shares = shares_around(target, ball, radius);
    for (std::size_t n = 0; n < shares.dof.size(); ++n)
      lamella_volume[shares.dof[n]] += ball.volume * (shares.weight[n] / shares.sum);
    injected += ball.volume;
  }
  return injected;
}

}  // namespace spume::rupture
