#include "spume/grid/spectral_filter.hpp"

#include "spume/base/contract.hpp"
#include "spume/grid/implementation.hpp"

namespace spume::grid {

struct SpectralFilter::Implementation {
  const Grid* grid;
  Transform* transform;        // of the grid, shared with every filter of this symmetry
  std::vector<double> factor;  // row by row in the transform's order, normalisation included
};

SpectralFilter::SpectralFilter(const Grid& grid, Symmetry symmetry,
                               const std::function<double(const Vec3& theta)>& factor)
    : SpectralFilter(grid, symmetry, [&](const AxisAngles& theta) -> FactorOfRow {
        return [&factor, theta](int mode_y, int mode_z, std::span<double> factors) {
          for (std::size_t m = 0; m < factors.size(); ++m)
            factors[m] = factor({theta[0][m], theta[1][mode_y], theta[2][mode_z]});
        };
      }) {}

SpectralFilter::SpectralFilter(const Grid& grid, Symmetry symmetry,
                               const std::function<FactorOfRow(const AxisAngles& theta)>& factor_of_row)
    : implementation_(std::make_unique<Implementation>()) {
  Transform& transform = transform_of(grid, symmetry);
  implementation_->grid = &grid;
  implementation_->transform = &transform;
  const std::size_t row_size = transform.theta(0).size();
  auto& table = implementation_->factor;
  table.resize(row_size * transform.n_rows());
  const FactorOfRow fill = factor_of_row({transform.theta(0), transform.theta(1), transform.theta(2)});
  for (int row = 0; row < transform.n_rows(); ++row)
    fill(transform.mode_y(row), transform.mode_z(row), std::span(table).subspan(row * row_size, row_size));
  for (double& value : table) value *= transform.normalisation();
}

SpectralFilter::~SpectralFilter() = default;
SpectralFilter::SpectralFilter(SpectralFilter&&) noexcept = default;

void SpectralFilter::apply(const Field& in, Field& out) const {
  const Implementation& self = *implementation_;
  expects(&in.grid() == self.grid && &out.grid() == self.grid, "a filter works on fields of its grid");
  const std::size_t row_size = self.transform->theta(0).size();
  self.transform->filter(in, out, [&](int row) { return self.factor.data() + row * row_size; });
}

}  // namespace spume::grid
