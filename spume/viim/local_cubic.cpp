#include "spume/viim/local_cubic.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace spume::viim {

namespace {

/// Weights of the points −1, 0, 1, 2 for the value at t and its first two derivatives.
struct Weights {
  std::array<double, 4> value, slope, bend;
};

Weights weights(double t) {
  return {{-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
           (t + 1) * t * (t - 1) / 6},
          {-(3 * t * t - 6 * t + 2) / 6, (3 * t * t - 4 * t - 1) / 2, -(3 * t * t - 2 * t - 2) / 2,
           (3 * t * t - 1) / 6},
          {1 - t, 3 * t - 2, 1 - 3 * t, t}};
}

}  // namespace

LocalCubic::LocalCubic(const grid::Box& box, const Vec3& x, const Values& value)
    : lower_(box.lower), h_(box.spacing()) {
  for (int d = 0; d < 3; ++d) corner_[d] = static_cast<int>(std::floor((x[d] - lower_[d]) / h_ - 0.5)) - 1;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        value_[(4 * k + j) * 4 + i] = value(corner_.i + i, corner_.j + j, corner_.k + k);
}

LocalCubic::Taylor LocalCubic::at(const Vec3& x) const {
  std::array<Weights, 3> w;
  for (int d = 0; d < 3; ++d) w[d] = weights((x[d] - lower_[d]) / h_ - 1.5 - corner_[d]);
  Taylor t{};
  std::array<double, 3> slope{};
  for (int k = 0; k < 4; ++k) {
    double p = 0, px = 0, py = 0, pxx = 0, pyy = 0, pxy = 0;
    for (int j = 0; j < 4; ++j) {
      const double* row = &value_[(4 * k + j) * 4];
      double q = 0, qx = 0, qxx = 0;
      for (int i = 0; i < 4; ++i) {
        q += w[0].value[i] * row[i];
        qx += w[0].slope[i] * row[i];
        qxx += w[0].bend[i] * row[i];
      }
      p += w[1].value[j] * q;
      px += w[1].value[j] * qx;
      py += w[1].slope[j] * q;
      pxx += w[1].value[j] * qxx;
      pyy += w[1].bend[j] * q;
      pxy += w[1].slope[j] * qx;
    }
    const double v = w[2].value[k], s = w[2].slope[k];
    t.value += v * p;
    slope[0] += v * px;
    slope[1] += v * py;
    slope[2] += s * p;
    t.hessian[0] += v * pxx;
    t.hessian[1] += v * pyy;
    t.hessian[2] += w[2].bend[k] * p;
    t.hessian[3] += v * pxy;
    t.hessian[4] += s * py;
    t.hessian[5] += s * px;
  }
  t.gradient = {slope[0] / h_, slope[1] / h_, slope[2] / h_};
  for (double& second : t.hessian) second /= h_ * h_;
  return t;
}

std::optional<Vec3> LocalCubic::closest_zero(const Vec3& x, const Vec3& start) const {
  constexpr int most_iterations = 20;
  constexpr double reach = 0.5, longest_step = 0.25, converged = 1e-9, smallest_gradient = 0.1;  // lengths: h
  Vec3 y = start;
  double lambda = 0;
  for (int n = 0; n < most_iterations; ++n) {
    const Taylor p = at(y);
    const Vec3& g = p.gradient;
    const double g2 = norm_squared(g);
    if (!(g2 > smallest_gradient * smallest_gradient)) return std::nullopt;
    if (n == 0) lambda = dot(x - y, g) / g2;
    const auto& s = p.hessian;
    const Vec3 residual = y - x + lambda * g;
    Eigen::Matrix4d matrix;
    const double l = lambda;
    matrix << 1 + l * s[0], l * s[3], l * s[5], g.x, l * s[3], 1 + l * s[1], l * s[4], g.y, l * s[5],
        l * s[4], 1 + l * s[2], g.z, g.x, g.y, g.z, 0;
    const Eigen::Vector4d step =
        matrix.partialPivLu().solve(-Eigen::Vector4d(residual.x, residual.y, residual.z, p.value));
    if (!step.allFinite()) return std::nullopt;
    Vec3 move{step[0], step[1], step[2]};
    const double length = norm(move),
                 shortening = std::min(1.0, longest_step * h_ / std::max(length, 1e-300));
    y += shortening * move;
    lambda += shortening * step[3];
    if (norm_squared(y - start) > reach * reach * h_ * h_) return std::nullopt;
    if (length < converged * h_) return y;
  }
  return std::nullopt;
}

}  // namespace spume::viim
