#pragma once

#include <functional>
#include <span>
#include <vector>

#include "spume/base/vec3.hpp"
#include "spume/transport/point_bins.hpp"

namespace spume::transport {

/// Dofs near a piece of film or border, with weights that fall from 1 on it to 0 at the radius.
struct Donors {
  std::vector<int> dof;
  std::vector<double> weight;

  bool empty() const { return dof.empty(); }
  /// Σ weight × value.
  double sum(std::span<const double> value) const;
  /// Takes fraction × weight of each dof's volume away.
  void take(double fraction, std::span<double> volume) const;
};

/// Weight as a function of z = 1 − r²/radius², r the distance to the closest point of the piece.
enum class Falloff { Linear, Square };

/// The dofs that `accept` takes nearer than `radius` [m] to any of `points`. Where there are none the radius
/// grows by 1.5, at most `n_tries` searches in all.
Donors find_donors(const PointBins& bins, std::span<const Vec3> points, double radius, int n_tries,
                   Falloff falloff, const std::function<bool(int dof)>& accept);

}  // namespace spume::transport
