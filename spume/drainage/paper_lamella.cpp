#include "spume/drainage/paper_lamella.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/fem/triangle_matrices.hpp"

namespace spume::drainage {
namespace {

/// Sums of all products of 1, 2, 3, 4 of three numbers, repetitions allowed. For a function that is linear on
/// a triangle of area A with these values at the corners, ∫ f³ = A h₃/10 and ∫ f⁴ = A h₄/15.
struct Products {
  double h1, h2, h3, h4;

  Products(double x, double y, double z) {
    const double p2 = x * x + x * y + y * y, p3 = x * p2 + y * y * y, p4 = x * p3 + y * y * y * y;
    h1 = x + y + z;
    h2 = p2 + z * h1;
    h3 = p3 + z * h2;
    h4 = p4 + z * h3;
  }
  /// h₃ of the three and w, one of them: ∫ f³ φ = A/60 of it, φ the basis function of that corner.
  double h3_with(double w) const { return h3 + w * (h2 + w * (h1 + w)); }
};

double dot_product(std::span<const double> x, std::span<const double> y) {
  return std::inner_product(x.begin(), x.end(), y.begin(), 0.0);
}

}  // namespace

PaperLamella::PaperLamella(LamellaSurface surface, const state::Materials& materials)
    : surface_(std::move(surface)),
      materials_(materials),
      laplacian_(fem::assemble_surface_laplacian(surface_.position, surface_.triangle, surface_.domain)) {
  const std::size_t n = surface_.position.size();
  expects(surface_.curvature_squared.size() == n && surface_.tangential_gravity.size() == n,
          "one curvature and one gravity per vertex");
  for (const auto& corner : surface_.triangle) {
    const Vec3 a = surface_.position[corner[0]], b = surface_.domain.near(surface_.position[corner[1]], a),
               c = surface_.domain.near(surface_.position[corner[2]], a);
    const Vec3 doubled = cross(b - a, c - a);
    const double size = norm_squared(doubled);
    area_.push_back(0.5 * std::sqrt(size));
    gradient_.push_back(
        {cross(doubled, c - b) / size, cross(doubled, a - c) / size, cross(doubled, b - a) / size});
  }
  build_matrices();
}

void PaperLamella::build_matrices() {
  const int n = n_nodes();
  std::vector<double> column(n, 0.0);
  const auto add_row_of_k = [&](int l, double factor) {  // K is symmetric: its row l is its column l
    for (int e = laplacian_.offset[l]; e < laplacian_.offset[l + 1]; ++e) {
      column[laplacian_.neighbour[e]] += factor * laplacian_.stiffness[e];
      column[l] -= factor * laplacian_.stiffness[e];
    }
  };
  column_offset_.push_back(0);
  for (int j = 0; j < n; ++j) {
    double k_jj = 0;
    for (int e = laplacian_.offset[j]; e < laplacian_.offset[j + 1]; ++e) {
      const int l = laplacian_.neighbour[e];
      add_row_of_k(l, laplacian_.stiffness[e] / laplacian_.mass[l]);
      k_jj -= laplacian_.stiffness[e];
    }
    add_row_of_k(j, k_jj / laplacian_.mass[j]);
    for (int i : fem::second_ring(laplacian_, j)) {
      row_.push_back(i);
      biharmonic_.push_back(column[i]);
      column[i] = 0;
    }
    column_offset_.push_back(static_cast<int>(row_.size()));
  }
  mass_.assign(row_.size(), 0.0);
  for (std::size_t t = 0; t < area_.size(); ++t) {
    const auto local = fem::triangle_mass(area_[t]);
    const auto& corner = surface_.triangle[t];
    for (int q = 0; q < 3; ++q) {
      const auto first = row_.begin() + column_offset_[corner[q]],
                 last = row_.begin() + column_offset_[corner[q] + 1];
      for (int p = 0; p < 3; ++p)
        mass_[std::lower_bound(first, last, corner[p]) - row_.begin()] += local[p][q];
    }
  }
  value_.resize(row_.size());
  lu_.emplace_back(column_offset_, row_);
}

void PaperLamella::integrate(std::span<const double> source, std::span<double> load) const {
  for (int j = 0; j < n_nodes(); ++j)
    for (int p = column_offset_[j]; p < column_offset_[j + 1]; ++p) load[row_[p]] += mass_[p] * source[j];
}

double PaperLamella::liquid(std::span<const double> eta) const {
  long double sum = 0;  // so that what the ledger shows is the scheme and not the summation
  for (int i = 0; i < n_nodes(); ++i) sum += static_cast<long double>(laplacian_.mass[i]) * eta[i];
  return static_cast<double>(sum);
}

void PaperLamella::add_explicit_terms(std::span<const double> eta, std::span<double> right) {
  laplacian_of_eta_.assign(n_nodes(), 0.0);  // p
  for (int i = 0; i < n_nodes(); ++i)
    for (int e = laplacian_.offset[i]; e < laplacian_.offset[i + 1]; ++e)
      laplacian_of_eta_[i] -=
          laplacian_.stiffness[e] * (eta[laplacian_.neighbour[e]] - eta[i]) / laplacian_.mass[i];
  const double sigma = materials_.film.surface_tension, rho = materials_.liquid.density;
  const double third_fluidity = 1 / (3 * materials_.liquid.viscosity);
  const auto& k = surface_.curvature_squared;
  for (std::size_t t = 0; t < area_.size(); ++t) {
    const auto& corner = surface_.triangle[t];
    const Products products(eta[corner[0]], eta[corner[1]], eta[corner[2]]);
    double cube_times_k = 0;  // 60/A of ∫ η³ k
    Vec3 pull{};              // 60/A of ∫ η³ g_s
    Vec3 slope_of_eta{}, slope_of_k{}, slope_of_p{};
    for (int c = 0; c < 3; ++c) {
      const int i = corner[c];
      const double weight = products.h3_with(eta[i]);
      cube_times_k += weight * k[i];
      pull += weight * surface_.tangential_gravity[i];
      slope_of_eta += eta[i] * gradient_[t][c];
      slope_of_k += k[i] * gradient_[t][c];
      slope_of_p += laplacian_of_eta_[i] * gradient_[t][c];
    }
    const Vec3 flux = sigma * (cube_times_k / 60 * slope_of_eta + products.h4 / 15 * slope_of_k +
                               products.h3 / 10 * slope_of_p) +
                      rho / 60 * pull;
    for (int c = 0; c < 3; ++c) right[corner[c]] += third_fluidity * area_[t] * dot(flux, gradient_[t][c]);
  }
}

bool PaperLamella::advance(double dt, std::span<const double> load, std::span<double> eta) {
  const double thickest = *std::max_element(eta.begin(), eta.end());
  const double alpha = 2 * thickest * thickest * thickest;
  right_.assign(load.begin(), load.end());
  add_explicit_terms(eta, right_);
  for (double& r : right_) r *= dt;
  const double gained = std::accumulate(right_.begin(), right_.end(), 0.0);
  const double speed = materials_.film.surface_tension / (3 * materials_.liquid.viscosity);  // σ/3μ
  if (!solve(alpha * dt * speed, right_)) return false;
  // What the iteration left undone is not lost: both sides of the system have the same sum.
  const double missing = (gained - dot_product(laplacian_.mass, right_)) /
                         std::accumulate(laplacian_.mass.begin(), laplacian_.mass.end(), 0.0);
  for (int i = 0; i < n_nodes(); ++i) eta[i] += right_[i] + missing;
  return std::isfinite(missing);
}

bool PaperLamella::factorise(double s) {
  // Within this range the iteration converges by a factor of ten and more a step.
  if (factorised_ && s >= 0.7 * *factorised_ && s <= 1.4 * *factorised_) return true;
  factorised_.reset();
  for (std::size_t p = 0; p < value_.size(); ++p) value_[p] = mass_[p] + s * biharmonic_[p];
  if (!lu_.front().factorise(value_)) return false;
  factorised_ = s;
  return true;
}

void PaperLamella::multiply(double s, std::span<const double> x, std::span<double> result) const {
  for (int j = 0; j < n_nodes(); ++j) {  // the matrix is symmetric: its columns are its rows
    double sum = 0;
    for (int p = column_offset_[j]; p < column_offset_[j + 1]; ++p)
      sum += (mass_[p] + s * biharmonic_[p]) * x[row_[p]];
    result[j] = sum;
  }
}

bool PaperLamella::solve(double s, std::span<double> right) {
  constexpr int most_iterations = 100;
  constexpr double tolerance = 1e-12, enough = 1e-6;  // of the residual: aimed at, and accepted
  if (!std::isfinite(s) || !factorise(s)) return false;
  const std::size_t n = right.size();
  const double first = dot_product(right, right);
  change_.assign(n, 0.0);
  product_.resize(n);
  double along = 0;  // r·P⁻¹r of the last iteration
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    scaled_.assign(right.begin(), right.end());
    lu_.front().solve(scaled_);
    const double next = dot_product(right, scaled_);
    if (iteration == 0) direction_.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      direction_[i] = scaled_[i] + (iteration == 0 ? 0.0 : next / along) * direction_[i];
    along = next;
    multiply(s, direction_, product_);
    const double curvature = dot_product(direction_, product_);
    if (!(curvature > 0)) break;  // the right side is zero, or round-off is all that is left
    const double length = along / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      change_[i] += length * direction_[i];
      right[i] -= length * product_[i];
    }
    if (!(dot_product(right, right) > tolerance * tolerance * first)) break;
  }
  const bool converged = std::isfinite(first) && dot_product(right, right) <= enough * enough * first;
  std::copy(change_.begin(), change_.end(), right.begin());
  return converged && std::all_of(right.begin(), right.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace spume::drainage
