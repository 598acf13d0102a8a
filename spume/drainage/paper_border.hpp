#pragma once

#include <optional>
#include <span>
#include <vector>

#include "spume/fem/tridiagonal.hpp"
#include "spume/state/materials.hpp"

namespace spume::drainage {

/// One Plateau border by itself: its edges in a row, or in a ring. Node i is the first end of edge i.
struct BorderCurve {
  std::vector<double> length;   ///< h of each edge [m]
  std::vector<double> descent;  ///< g·(x₁ − x₀) of each edge, x₀ its first end [m²/s²]
  bool closed = false;          ///< a ring: the last edge ends at node 0

  int n_edges() const { return static_cast<int>(length.size()); }
  int n_nodes() const { return n_edges() + (closed ? 0 : 1); }
};

/// Where a border begins at a junction, or ends there.
struct BorderTip {
  int curve;
  bool at_end;  ///< at its last node, not at node 0
};

/// Borders, each with nodes of its own, and the junctions that they share.
struct BorderCurves {
  std::vector<BorderCurve> curve;
  std::vector<std::vector<BorderTip>> junction;  ///< the borders of each, four in a foam
};

/// What a border that leaves a junction brings to the balance there: its first two edges and the λ beyond.
struct JunctionArm {
  double h0, h1;            ///< lengths of its first and second edge [m]
  double lambda1, lambda2;  ///< λ one and two edges away [m²]
  double gravity;  ///< g·τ at the junction, τ pointing away from it, by the same differences [m/s²]
};

/// ∂λ/∂ℓ at the junction, away from it, to second order, if λ is lambda0 there.
/// Paper: Sec. 3.3.4, Eq. (13).
///   (λ₁ − λ₀)/h₀ + [h₁ (λ₁ − λ₀) + h₀ (λ₁ − λ₂)]/(h₁ (h₀ + h₁)), the bracket of the balance at a junction
double junction_slope(const JunctionArm& arm, double lambda0);

/// The common λ₀ [m²] at a junction, from the balance of the fluxes W; none if no positive one exists.
/// Paper: Sec. 3.3.4, Eq. (14).
///   C (a − b z²) − d z³ = 0, λ₀ = z²; of two positive roots, which d < 0 may give, the smaller: it is the
///   one that tends to the λ next to the junction
std::optional<double> junction_area(std::span<const JunctionArm> arms, const state::Materials& materials);

/// What one border brings to the balance at the junction [N m]: it loses (C_Δ/μ) W there.
/// Paper: Sec. 3.3.4, Eq. (15).
///   W = C₁ λ₀^{1/2} ∂λ/∂ℓ − λ₀² ρ g_i, C₁ = ½ σ (√3 − π/2)^{1/2}; ΣW = 0 over the junction
double junction_flux(const JunctionArm& arm, double lambda0, const state::Materials& materials);

/// Where a border step failed: a junction without a λ, or a node of a border with one that is not positive.
struct BorderFault {
  int junction = -1;
  int curve = -1, node = -1;
  double value = 0;  ///< that λ [m²]
};

/// The published scheme of the borders: first order in time, linear elements in ℓ. Each border has its own λ
/// at a junction between advance() and project().
class PaperBorders {
 public:
  /// Every border that meets a junction needs two edges. Takes the borders as they are; throws InputError
  /// where one with a junction has fewer.
  PaperBorders(BorderCurves borders, const state::Materials& materials);

  /// λ of curve c are the nodes [offset()[c], offset()[c + 1]) of every array.
  std::span<const int> offset() const { return offset_; }
  int n_nodes() const { return offset_.back(); }
  const BorderCurves& curves() const { return borders_; }

  /// Adds ∫ S φ of a piecewise linear S [m²/s] to the load [m³/s].
  void integrate(std::span<const double> source, std::span<double> load) const;
  /// ∫ λ dℓ [m³].
  double liquid(std::span<const double> lambda) const;

  /// Replaces λ^n [m²], all positive, by the λ~ of one step, with ∫ S φ in `load` [m³/s].
  /// Paper: Sec. 3.3.3, Eq. (12).
  ///   ∫ (λ~ − λ)/Δt φ = (C_Δ/μ) { ∫ [−C₁ (λ^{1/2} λ_ℓ + α (λ~ − λ)_ℓ) + λ² ρ g_τ] φ_ℓ − Σ W φ } + ∫ S φ
  /// with α = 2 max λ^{1/2} of each border, the consistent mass, and λ^{1/2}, λ² integrated exactly. The
  /// paper prints +∫ W φ; since derivative and gravity in W point away from the junction at both ends, what
  /// enters the border there is −(C_Δ/μ) W.
  std::optional<BorderFault> advance(double dt, std::span<const double> load, std::span<double> lambda);

  /// Gives the borders of each junction one λ there, and keeps the liquid (Sec. 3.3.4):
  ///   λ₀ = Σ λ~_{i,0} h_{i,0} / Σ h_{i,0}
  void project(std::span<double> lambda) const;

 private:
  JunctionArm arm(const BorderTip& tip, std::span<const double> lambda) const;
  int tip_node(const BorderTip& tip) const;
  bool find_junction_fluxes(std::span<const double> lambda, BorderFault& fault);
  void advance_curve(int c, double dt, std::span<const double> load, std::span<double> lambda);

  BorderCurves borders_;
  state::Materials materials_;
  std::vector<int> offset_;
  std::vector<double> tip_flux_;  ///< (C_Δ/μ) W at the nodes that are tips, 0 elsewhere
  std::vector<JunctionArm> arms_;
  fem::SymmetricTridiagonal matrix_;
  std::vector<double> change_;
};

}  // namespace spume::drainage
