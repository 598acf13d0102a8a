#include "spume/verification/modes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"

namespace spume::verification {

namespace {

/// Solid angle of a triangle seen from the origin (van Oosterom and Strackee).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Sum of squares of what a damped cosine of given ω and γ leaves of the samples.
double misfit(std::span<const double> time, std::span<const double> value, double omega, double gamma) {
  const auto n = static_cast<Eigen::Index>(time.size());
  Eigen::MatrixXd matrix(n, 3);
  Eigen::VectorXd right(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double e = std::exp(-gamma * (time[i] - time[0]));
    matrix.row(i) << e * std::cos(omega * time[i]), e * std::sin(omega * time[i]), 1;
    right(i) = value[i];
  }
  const Eigen::VectorXd c = matrix.colPivHouseholderQr().solve(right);
  return (matrix * c - right).squaredNorm();
}

}  // namespace

Vec3 centroid(const mesh::FilmMesh& films, mesh::Phase bubble) {
  expects(!films.position.empty(), "a bubble with films");
  const Vec3 origin = films.position.front();
  double volume = 0;
  Vec3 moment;
  for (const auto& t : films.triangle) {
    if (t.phase_a != bubble && t.phase_b != bubble) continue;
    const double sign = t.phase_a == bubble ? 1 : -1;
    const Vec3 a = films.position[t.vertex[0]] - origin, b = films.position[t.vertex[1]] - origin,
               c = films.position[t.vertex[2]] - origin;
    const double v = sign * dot(a, cross(b, c)) / 6;
    volume += v;
    moment += v / 4 * (a + b + c);
  }
  return origin + moment / volume;
}

double mode_amplitude(const mesh::FilmMesh& films, mesh::Phase bubble, int n) {
  const Vec3 centre = centroid(films, bubble);
  double sum = 0;
  for (const auto& t : films.triangle) {
    if (t.phase_a != bubble && t.phase_b != bubble) continue;
    const Vec3 corner[3] = {films.position[t.vertex[0]] - centre, films.position[t.vertex[1]] - centre,
                            films.position[t.vertex[2]] - centre};
    double mean = 0;  // of r P_n over the triangle, by its middles of sides
    for (int c = 0; c < 3; ++c) {
      const Vec3 middle = 0.5 * (corner[c] + corner[(c + 1) % 3]);
      const double r = 0.5 * (norm(corner[c]) + norm(corner[(c + 1) % 3]));
      mean += r * std::legendre(n, std::clamp(middle.z / norm(middle), -1.0, 1.0)) / 3;
    }
    sum += mean * std::abs(solid_angle(corner[0], corner[1], corner[2]));
  }
  return (2 * n + 1) / (4 * std::numbers::pi) * sum;
}

Decay fit_damped_cosine(std::span<const double> time, std::span<const double> value, const Decay& guess) {
  expects(time.size() == value.size() && time.size() >= 8, "at least eight samples");
  Eigen::Vector2d p(guess.omega, guess.gamma);
  const auto f = [&](const Eigen::Vector2d& x) { return misfit(time, value, x(0), x(1)); };
  // Newton's method on the misfit with differences, damped by halving: two unknowns only.
  double best = f(p);
  for (int n = 0; n < 100; ++n) {
    const Eigen::Vector2d step(1e-4 * guess.omega, 1e-4 * guess.omega);
    Eigen::Vector2d gradient;
    Eigen::Matrix2d hessian;
    for (int a = 0; a < 2; ++a) {
      const Eigen::Vector2d da = step(a) * Eigen::Vector2d::Unit(a);
      gradient(a) = (f(p + da) - f(p - da)) / (2 * step(a));
      for (int b = 0; b < 2; ++b) {
        const Eigen::Vector2d db = step(b) * Eigen::Vector2d::Unit(b);
        hessian(a, b) =
            (f(p + da + db) - f(p + da - db) - f(p - da + db) + f(p - da - db)) / (4 * step(a) * step(b));
      }
    }
    if (hessian.determinant() <= 0 || hessian(0, 0) <= 0)
      hessian += gradient.norm() / (0.05 * guess.omega) * Eigen::Matrix2d::Identity();
    Eigen::Vector2d change = -hessian.ldlt().solve(gradient);
    int halvings = 0;
    while (halvings < 20 && !(f(p + change) <= best)) {
      change *= 0.5;
      ++halvings;
    }
    if (halvings == 20 || change.norm() < 1e-7 * guess.omega) return {.omega = p(0), .gamma = p(1)};
    p += change;
    best = f(p);
  }
  throw NumericalError("the fit of a damped cosine did not converge");
}

}  // namespace spume::verification
