#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "spume/base/domain.hpp"
#include "spume/base/vec3.hpp"
#include "spume/fem/sparse_lu.hpp"
#include "spume/fem/surface_laplacian.hpp"
#include "spume/state/materials.hpp"

namespace spume::drainage {

/// What the published lamella step knows of one lamella: its triangles and, at its vertices, position, k and
/// tangential gravity.
struct LamellaSurface {
  std::vector<Vec3> position;  ///< [m]
  std::vector<std::array<int, 3>> triangle;
  std::vector<double> curvature_squared;  ///< k = k₁² + k₂² [1/m²]
  std::vector<Vec3> tangential_gravity;   ///< g_s = g − (g·n) n [m/s²]
  Domain domain;                          ///< periodic or not, as of the film mesh
};

/// The published scheme of one lamella: linear elements in space, first order in time.
class PaperLamella {
 public:
  /// Throws NumericalError, with the place, where a triangle or a vertex has no area.
  PaperLamella(LamellaSurface surface, const state::Materials& materials);

  int n_nodes() const { return laplacian_.size(); }
  const LamellaSurface& surface() const { return surface_; }

  /// Adds ∫ f φ of a piecewise linear f [m/s] to the load [m³/s].
  void integrate(std::span<const double> source, std::span<double> load) const;
  /// ∫ η dA [m³].
  double liquid(std::span<const double> eta) const;

  /// Replaces η^n [m] by η^{n+1}, whatever its sign: the caller checks. `load` holds what comes in through
  /// the boundary and from elsewhere, such as −½ ∫ Q φ over the boundary [m³/s]. False where η is not finite,
  /// or where the iteration leaves more than 1e-6 of the norm of the residual that it began with.
  /// Paper: Sec. 3.3.2, Eq. (9).
  ///   (η^{n+1} − η^n)/Δt + α (σ/3μ) Δ_s² (η^{n+1} − η^n) + ∇_s·Q(η^n) = 0,   α = 2 max η³,   ∂η/∂ν = 0
  bool advance(double dt, std::span<const double> load, std::span<double> eta);

 private:
  /// Adds to each balance [m³/s] the terms at time n, with k, η, g_s linear in each triangle and the products
  /// integrated exactly.
  /// Paper: Sec. 3.3.2, Eq. (10).
  ///   (1/3μ) ∫ [σ η³ ∇_s(kη + p) + ρ g_s η³]·∇_s φ,   ∫ p ψ = −∫ ∇_s η·∇_s ψ with the lumped mass on the
  ///   left
  void add_explicit_terms(std::span<const double> eta, std::span<double> right);

  /// Replaces the right side by the change of η; conjugate gradients with the factors of an earlier matrix,
  /// since α changes little from step to step. They go on to 1e-12 of the first residual; false where they
  /// end above 1e-6 of it.
  /// Paper: Sec. 3.3.2, Eq. (11).
  ///   (M + s K M~⁻¹ K)(η^{n+1} − η^n) = right,   s = α Δt σ/3μ, M~ the row sums of M
  bool solve(double s, std::span<double> right);

  void build_matrices();
  bool factorise(double s);
  /// result = (M + s K M~⁻¹ K) x
  void multiply(double s, std::span<const double> x, std::span<double> result) const;

  LamellaSurface surface_;
  state::Materials materials_;
  fem::SurfaceLaplacian laplacian_;            ///< M~, the row sums of M, and K
  std::vector<std::array<Vec3, 3>> gradient_;  ///< ∇φ of the corners of each triangle [1/m]
  std::vector<double> area_;                   ///< of each triangle [m²]
  std::vector<int> column_offset_, row_;       ///< of the matrices, by columns
  std::vector<double> mass_, biharmonic_;      ///< M [m²] and K M~⁻¹ K [1/m²]
  std::vector<double> value_;                  ///< of one matrix before its factorisation
  std::vector<fem::SparseLu> lu_;              ///< one
  std::optional<double> factorised_;           ///< s of the factors
  std::vector<double> laplacian_of_eta_, right_, change_, direction_, scaled_, product_;
};

}  // namespace spume::drainage
