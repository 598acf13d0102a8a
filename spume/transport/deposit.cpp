#include "spume/transport/deposit.hpp"

#include "spume/base/error.hpp"

namespace spume::transport {

namespace {

struct Weights {
  std::vector<int> dof;
  std::vector<double> weight;
  double sum = 0;

  void give(double amount, std::span<double> volume) const {
    for (std::size_t n = 0; n < dof.size(); ++n) volume[dof[n]] += amount * (weight[n] / sum);
  }
};

/// measure × (1 − r²/radius²)² of the points of a ball.
Weights weights_around(const PointBins& bins, const Vec3& x, double radius, std::span<const double> measure) {
  std::vector<Neighbour> found;
  bins.within(x, radius, found);
  Weights weights;
  for (const Neighbour& near : found) {
    const double z = 1 - near.distance_squared / (radius * radius);
    weights.dof.push_back(near.point);
    weights.weight.push_back(z * z * measure[near.point]);
    weights.sum += weights.weight.back();
  }
  return weights;
}

}  // namespace

bool give_to_borders(const LiquidMesh& mesh, const Vec3& x, double amount, double radius, double h,
                     std::span<double> border_volume) {
  const Weights weights = weights_around(mesh.border_bins, x, radius, mesh.dof_length);
  if (!(weights.sum >= 0.3 * h)) return false;
  weights.give(amount, border_volume);
  return true;
}

void give_to_films(const LiquidMesh& mesh, const Vec3& x, double amount, double radius, double h,
                   std::span<double> film_volume) {
  constexpr int n_growths = 40;  // 1.5⁴⁰ ≈ 10⁷: beyond every film
  for (int n = 0; n < n_growths; ++n, radius *= 1.5) {
    const Weights weights = weights_around(mesh.film_bins, x, radius, mesh.dof_area);
    // A foam that has less film than that altogether takes it where it has any.
    const double enough = n < 6 ? 0.3 * h * h : 0;
    if (!(weights.sum > enough)) continue;
    weights.give(amount, film_volume);
    return;
  }
  throw NumericalError("no film is left to take the liquid of the films that vanished");
}

}  // namespace spume::transport
