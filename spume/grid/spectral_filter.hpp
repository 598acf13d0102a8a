#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "spume/grid/field.hpp"

namespace spume::grid {

/// Multiplies the trigonometric coefficients of a field by a real factor m(θ), even in each θ_d, where θ_d ∈
/// [0, π] is the phase advance over one cell along direction d (wave number k_d = θ_d / h). Periodic
/// directions use the discrete Fourier transform, walls the cosine (even) or sine (odd) transform of
/// cell-centred values (DCT-II, DST-II). The factor is tabulated once; applying costs one transform pair.
/// m(0) multiplies the mean. The filters of one grid share its plans and buffers, one set a symmetry.
class SpectralFilter {
 public:
  /// Collective. `symmetry`: of the fields that it will be applied to, whatever symmetry they carry
  /// themselves.
  SpectralFilter(const Grid& grid, Symmetry symmetry, const std::function<double(const Vec3& theta)>& factor);
  /// The same for factors that are made of functions of one angle each, and so best tabulated by axis: given
  /// the angles of the modes along x, y and z, `factor_of_row` fills the factors of a row of modes along x,
  /// whose numbers along y and z it is given. Collective.
  using AxisAngles = std::array<std::span<const double>, 3>;
  using FactorOfRow = std::function<void(int mode_y, int mode_z, std::span<double> factors)>;
  SpectralFilter(const Grid& grid, Symmetry symmetry,
                 const std::function<FactorOfRow(const AxisAngles& theta)>& factor_of_row);
  ~SpectralFilter();
  SpectralFilter(SpectralFilter&&) noexcept;

  /// Collective. `in` and `out` may be the same field.
  void apply(const Field& in, Field& out) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace spume::grid
