#include "spume/verification/rim_reference.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "spume/base/error.hpp"
#include "spume/drainage/suction.hpp"

namespace spume::verification {

namespace {

using Vector = Eigen::VectorXd;

class OneDimensionalFilm {
 public:
  OneDimensionalFilm(const FlatFilm& film, const state::Materials& materials, double finest)
      : film_(film),
        materials_(materials),
        speed_(materials.film.surface_tension / (3 * materials.liquid.viscosity)) {
    double x = 0;
    for (double h = finest; x < film.half_width; h *= 1.04) {
      width_.push_back(h);
      x += h;
    }
    double left = 0;
    for (double& h : width_) {
      h *= film.half_width / x;
      centre_.push_back(left + 0.5 * h);
      left += h;
    }
  }

  int size() const { return static_cast<int>(width_.size()); }

  /// η at x = 0 by a parabola of slope zero there.
  double rim(const Vector& eta) const {
    const double s0 = centre_[0] * centre_[0], s1 = centre_[1] * centre_[1];
    return (eta(0) * s1 - eta(1) * s0) / (s1 - s0);
  }

  Vector rates(const Vector& eta) const {
    const int n = size();
    Vector slope = Vector::Zero(n + 1), potential(n), flux = Vector::Zero(n + 1);
    for (int f = 1; f < n; ++f) slope(f) = (eta(f) - eta(f - 1)) / (centre_[f] - centre_[f - 1]);
    for (int i = 0; i < n; ++i) potential(i) = speed_ * (slope(i + 1) - slope(i)) / width_[i];
    for (int f = 1; f < n; ++f) {
      const double a = eta(f - 1), b = eta(f), mobility = 0.25 * (a + b) * (a * a + b * b);
      flux(f) = mobility * (potential(f) - potential(f - 1)) / (centre_[f] - centre_[f - 1]);
    }
    flux(0) = -0.5 * drainage::suction(rim(eta), film_.border_area, materials_);
    Vector rate(n);
    for (int i = 0; i < n; ++i) rate(i) = -(flux(i + 1) - flux(i)) / width_[i];
    return rate;
  }

  /// ∂rates/∂η, five diagonals, by differences of five groups of columns.
  Eigen::SparseMatrix<double> jacobian(const Vector& eta) const {
    constexpr int band = 2, groups = 2 * band + 1;
    const int n = size();
    std::vector<Eigen::Triplet<double>> entries;
    const Vector base = rates(eta);
    for (int group = 0; group < groups; ++group) {
      Vector shifted = eta;
      for (int j = group; j < n; j += groups) shifted(j) *= 1 + 1e-7;
      const Vector change = rates(shifted) - base;
      for (int j = group; j < n; j += groups)
        for (int i = std::max(0, j - band); i <= std::min(n - 1, j + band); ++i)
          entries.emplace_back(i, j, change(i) / (shifted(j) - eta(j)));
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// η after one linearly implicit Euler step.
  Vector euler(const Vector& eta, double dt) const {
    Eigen::SparseMatrix<double> matrix = -dt * jacobian(eta);
    for (int i = 0; i < size(); ++i) matrix.coeffRef(i, i) += 1;
    matrix.makeCompressed();
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
    return eta + dt * lu.solve(rates(eta));
  }

 private:
  FlatFilm film_;
  state::Materials materials_;
  double speed_;  ///< σ/3μ [m/s]
  std::vector<double> width_, centre_;
};

}  // namespace

std::vector<double> rim_of_flat_film(const FlatFilm& film, const state::Materials& materials, double finest,
                                     std::span<const double> times) {
  constexpr double tolerance = 2e-4;
  const OneDimensionalFilm equations(film, materials, finest);
  Vector eta = Vector::Constant(equations.size(), film.half_thickness);
  std::vector<double> rims;
  double t = 0, dt = 1e-7 * times.back();
  for (const double end : times) {
    while (t < end) {
      const double step = std::min(dt, end - t);
      const Vector whole = equations.euler(eta, step);
      const Vector halves = equations.euler(equations.euler(eta, 0.5 * step), 0.5 * step);
      const double error = ((halves - whole).array() / halves.array()).abs().maxCoeff() / tolerance;
      const bool positive = whole.minCoeff() > 0 && halves.minCoeff() > 0;
      dt = step * (positive ? std::clamp(0.85 / std::sqrt(std::max(error, 1e-12)), 0.2, 2.0) : 0.25);
      if (dt < 1e-14 * times.back()) throw NumericalError("the one-dimensional film stalled");
      if (!positive || !(error <= 1)) continue;
      eta = 2 * halves - whole;
      t = step == end - t ? end : t + step;
    }
    rims.push_back(equations.rim(eta));
  }
  return rims;
}

}  // namespace spume::verification
