#include "spume/fem/lagged_lu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spume/base/contract.hpp"

namespace spume::fem {
namespace {

double weighted_product(std::span<const double> a, std::span<const double> b,
                        std::span<const double> weight) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += weight[i] * a[i] * b[i];
  return sum;
}

/// y += factor x
void add(double factor, std::span<const double> x, std::span<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += factor * x[i];
}

double largest(std::span<const double> x, std::span<const double> scale) {
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, std::abs(x[i]) / scale[i]);
  return most;
}

}  // namespace

LaggedLu::LaggedLu(std::span<const int> column_offset, std::span<const int> row)
    : column_offset_(column_offset.begin(), column_offset.end()),
      row_(row.begin(), row.end()),
      value_(row.size()),
      lu_(column_offset, row),
      x_(column_offset.size() - 1),
      residual_(x_.size()) {}

bool LaggedLu::factorise() {
  factorised_ = current_ = lu_.factorise(value_);
  iterations_ = 0;
  ++n_factorisations_;
  return factorised_;
}

bool LaggedLu::assign(std::span<const double> value) {
  expects(value.size() == value_.size(), "one value per entry of the pattern");
  if (!std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); })) return false;
  std::copy(value.begin(), value.end(), value_.begin());
  current_ = false;
  if (factorised_ && iterations_ < worth_of_factorisation) return true;
  return factorise();
}

void LaggedLu::solve(std::span<double> right, std::span<const double> scale, std::span<const double> weight) {
  expects(right.size() == x_.size() && scale.size() == x_.size() && weight.size() == x_.size(),
          "one entry per row");
  if (factorised_ && !current_ && iterate(right, scale, weight)) {
    std::copy(x_.begin(), x_.end(), right.begin());
    return;
  }
  if (current_ || factorise())
    lu_.solve(right);
  else
    std::fill(right.begin(), right.end(), std::numeric_limits<double>::quiet_NaN());
}

bool LaggedLu::iterate(std::span<const double> right, std::span<const double> scale,
                       std::span<const double> weight) {
  std::fill(x_.begin(), x_.end(), 0.0);
  std::copy(right.begin(), right.end(), residual_.begin());
  double before = weighted_product(residual_, residual_, weight);
  if (before == 0) return true;
  for (int n = 0; n < most_iterations; ++n) {
    const double length = new_direction(n, weight);
    if (!(length > 0) || !std::isfinite(length)) return false;
    const double step = weighted_product(q_[n], residual_, weight);
    add(step, z_[n], x_);
    add(-step, q_[n], residual_);
    if (n > 0) ++iterations_;
    // The next correction is about this one times the factor by which the residual has shrunk.
    const double after = weighted_product(residual_, residual_, weight);
    const double left = std::sqrt(after / before) * std::abs(step) * largest(z_[n], scale);
    if (left <= tolerance * largest(x_, scale)) return true;
    before = after;
  }
  return false;
}

double LaggedLu::new_direction(int n, std::span<const double> weight) {
  if (n == static_cast<int>(z_.size())) {
    z_.emplace_back(x_.size());
    q_.emplace_back(x_.size());
  }
  std::vector<double>&z = z_[n], &q = q_[n];
  std::copy(residual_.begin(), residual_.end(), z.begin());
  lu_.solve(z);
  multiply(z, q);
  for (int m = 0; m < n; ++m) {
    const double along = weighted_product(q, q_[m], weight);
    add(-along, q_[m], q);
    add(-along, z_[m], z);
  }
  const double length = std::sqrt(weighted_product(q, q, weight));
  for (double& v : q) v /= length;
  for (double& v : z) v /= length;
  return length;
}

void LaggedLu::multiply(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t j = 0; j < x.size(); ++j)
    for (int p = column_offset_[j]; p < column_offset_[j + 1]; ++p) y[row_[p]] += value_[p] * x[j];
}

}  // namespace spume::fem
