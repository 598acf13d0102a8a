#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/grid/box.hpp"
#include "tests/support/exact_flows.hpp"

namespace spume::testing {

inline constexpr double box_length = 0.01;  // [m]

inline grid::Box cube(int cells, std::array<grid::Boundary, 3> boundary) {
  return {{0, 0, 0}, {box_length, box_length, box_length}, {cells, cells, cells}, boundary};
}
inline grid::Box cube(int cells, grid::Boundary boundary) {
  return cube(cells, {boundary, boundary, boundary});
}

/// A smooth vector field of a few random long waves that vanishes, with its normal derivative along the
/// normal direction, at the faces of the cube across every direction that is not periodic. The same on any
/// number of ranks.
inline std::function<Vec3(const Vec3&)> smooth_field(const grid::Box& box, double size, std::uint64_t seed) {
  struct Wave {
    Vec3 k, amplitude;
    double phase;
  };
  Random random(seed);
  std::vector<Wave> waves(6);
  const double unit = 2 * std::numbers::pi / box_length;
  for (Wave& wave : waves) {
    for (int d = 0; d < 3; ++d) {
      wave.k[d] = unit * (static_cast<int>(random.next() % 5) - 2);
      wave.amplitude[d] = size * random.uniform(-1, 1) / 2;
    }
    wave.phase = random.uniform(0, 2 * std::numbers::pi);
  }
  return [=](const Vec3& x) {
    Vec3 value;
    for (const Wave& wave : waves) value += std::cos(dot(wave.k, x) + wave.phase) * wave.amplitude;
    for (int d = 0; d < 3; ++d)
      if (box.boundary[d] != grid::Boundary::Periodic)
        value *= std::pow(std::sin(std::numbers::pi * x[d] / box_length), 2);
    return value;
  };
}

}  // namespace spume::testing
