#include "spume/viim/advance.hpp"

#include <algorithm>
#include <array>

#include "spume/base/contract.hpp"

namespace spume::viim {

namespace {

/// Derivative at the third of six points whose differences, over the spacing and from the upwind end, are d.
double weno(const std::array<double, 5>& d) {
  constexpr double epsilon = 1e-6;  // of a distance, whose derivatives are of order one
  const auto square = [](double x) { return x * x; };
  const double rough0 =
                   13.0 / 12 * square(d[0] - 2 * d[1] + d[2]) + 0.25 * square(d[0] - 4 * d[1] + 3 * d[2]),
               rough1 = 13.0 / 12 * square(d[1] - 2 * d[2] + d[3]) + 0.25 * square(d[1] - d[3]),
               rough2 =
                   13.0 / 12 * square(d[2] - 2 * d[3] + d[4]) + 0.25 * square(3 * d[2] - 4 * d[3] + d[4]);
  const double w0 = 0.1 / square(epsilon + rough0), w1 = 0.6 / square(epsilon + rough1),
               w2 = 0.3 / square(epsilon + rough2);
  return (w0 * (2 * d[0] - 7 * d[1] + 11 * d[2]) + w1 * (-d[1] + 5 * d[2] + 2 * d[3]) +
          w2 * (2 * d[2] + 5 * d[3] - d[4])) /
         (6 * (w0 + w1 + w2));
}

/// Differences of the signed functions, on the whole box.
class Upwind {
 public:
  explicit Upwind(const DistanceField& field)
      : phase_(field.phase), n_(field.box.cells), per_h_(1 / field.box.spacing()) {}

  /// u·∇s of the phase of a cell, s = `distance` or minus that.
  double operator()(std::span<const double> distance, std::size_t cell, const Vec3& u) const {
    const std::array<std::ptrdiff_t, 3> stride{1, n_.i, static_cast<std::ptrdiff_t>(n_.i) * n_.j};
    const std::array<int, 3> place{static_cast<int>(cell % n_.i), static_cast<int>(cell / n_.i % n_.j),
                                   static_cast<int>(cell / stride[2])};
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (u[axis] == 0) continue;
      const int upwind = u[axis] > 0 ? -1 : 1;
      std::array<double, 6> s;  // from three cells upwind to two cells downwind; the edge of the box repeats
      for (int m = 0; m < 6; ++m) {
        const int wanted = place[axis] + (3 - m) * upwind, there = std::clamp(wanted, 0, n_[axis] - 1);
        const std::size_t c = cell + (there - place[axis]) * stride[axis];
        s[m] = phase_[c] == phase_[cell] ? distance[c] : -distance[c];
      }
      std::array<double, 5> d;
      for (int m = 0; m < 5; ++m) d[m] = (s[m + 1] - s[m]) * per_h_;
      sum += std::abs(u[axis]) * weno(d);
    }
    return sum;
  }

 private:
  std::span<const mesh::Phase> phase_;
  Index3 n_;
  double per_h_;
};

}  // namespace

std::vector<Vec3> extension_velocity(std::span<const ClosestPoint> band, const grid::VectorField& velocity,
                                     const grid::KernelCoupling& kernel) {
  std::vector<Vec3> points, u;
  points.reserve(band.size());
  for (const ClosestPoint& p : band) points.push_back(p.point);
  kernel.sample(velocity, points, u);
  return u;
}

void advance(DistanceField& field, std::span<const ClosestPoint> band, std::span<const Vec3> velocity,
             double dt) {
  expects(band.size() == velocity.size(), "every cell of the band has a velocity");
  const Upwind upwind(field);
  std::vector<double> from(field.distance), to(field.distance);
  for (const double share : {1.0, 0.25, 2.0 / 3}) {  // of a new Euler step in each of the three averages
    for (std::size_t n = 0; n < band.size(); ++n) {
      const std::size_t c = band[n].cell;
      const double euler = from[c] - dt * upwind(from, c, velocity[n]);
      to[c] = (1 - share) * field.distance[c] + share * euler;
    }
    std::swap(from, to);
  }
  field.distance = std::move(from);
}

}  // namespace spume::viim
