#include "spume/transport/donors.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace spume::transport {

namespace {

/// Each accepted point within the radius of any of `points`, once, with its distance to the closest of them.
std::vector<Neighbour> neighbours_of_piece(const PointBins& bins, std::span<const Vec3> points, double radius,
                                           const std::function<bool(int dof)>& accept) {
  std::vector<Neighbour> all, found;
  for (const Vec3& x : points) {
    bins.within(x, radius, found);
    std::copy_if(found.begin(), found.end(), std::back_inserter(all),
                 [&](const Neighbour& near) { return accept(near.point); });
  }
  std::sort(all.begin(), all.end(), [](const Neighbour& a, const Neighbour& b) {
    return std::tie(a.point, a.distance_squared) < std::tie(b.point, b.distance_squared);
  });
  all.erase(std::unique(all.begin(), all.end(),
                        [](const Neighbour& a, const Neighbour& b) { return a.point == b.point; }),
            all.end());
  return all;
}

}  // namespace

double Donors::sum(std::span<const double> value) const {
  double total = 0;
  for (std::size_t n = 0; n < dof.size(); ++n) total += weight[n] * value[dof[n]];
  return total;
}

void Donors::take(double fraction, std::span<double> volume) const {
  for (std::size_t n = 0; n < dof.size(); ++n) volume[dof[n]] *= 1 - fraction * weight[n];
}

Donors find_donors(const PointBins& bins, std::span<const Vec3> points, double radius, int n_tries,
                   Falloff falloff, const std::function<bool(int dof)>& accept) {
  Donors donors;
  for (int n = 0; n < n_tries && donors.empty(); ++n, radius *= 1.5)
    for (const Neighbour& near : neighbours_of_piece(bins, points, radius, accept)) {
      const double z = 1 - near.distance_squared / (radius * radius);
      donors.dof.push_back(near.point);
      donors.weight.push_back(falloff == Falloff::Square ? z * z : z);
    }
  return donors;
}

}  // namespace spume::transport
