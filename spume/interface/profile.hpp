#pragma once

#include <span>
#include <vector>

namespace spume::interface {

/// The smoothing kernel in Fourier space as a function of z = s k²/2, s its variance [m²]: T(z) = e^{−z}(1 +
/// z + z²/2). Its second and fourth moments in space vanish; over the tangent plane of a film its second
/// moment does not, so smoothing moves a curved film as curvature flow over the "time" s/10 does (see
/// step_in_advance.hpp).
double smoothing_kernel(double z);
/// T(z) without its exponential, 1 + z + z²/2.
inline double smoothing_polynomial(double z) {
  return 1 + z + 0.5 * z * z;
}

/// c − ½ across a flat film, where the smoothed indicator of the phase at x > 0 is c(x) [−]. With u = x²/s
/// and G the Gaussian of variance s, the kernel above integrated over the plane is K = (u² − 10u + 15) G/8,
/// and its primitive
///   F(x) = ½ erf(x/√(2s)) + x G (7 − u)/8.
double flat_film_profile(double x, double variance);

/// The inverse of the profile: the map from a smoothed indicator to a distance. It makes a flat film's
/// indicator a signed distance, while order and equality of indicators stay what they are. The profile is
/// continued linearly where its slope has fallen below `floor` × its maximum, so that the map is defined for
/// all c.
class FlatFilmMap {
 public:
  FlatFilmMap(double variance, double floor);
  /// ψ [m] of the indicator c: positive for c > ½.
  double distance(double indicator) const;
  /// The same in place of each indicator.
  void to_distances(std::span<double> indicators) const;

 private:
  static constexpr int n_steps = 1024;  ///< cubics between them are good to 1e-13 of the width
  /// Between two knots: Hermite's cubic as where it starts, its chord, and how much its slopes at both ends
  /// exceed that, all by the number of steps.
  struct Piece {
    double start, chord, excess_at_start, excess_at_end;
  };
  static double distance_of(double indicator, double steps_per_value, const Piece* pieces);

  double steps_per_value_;
  std::vector<Piece> piece_;  ///< at equal steps of c − ½; the last is the straight line without end
};

}  // namespace spume::interface
