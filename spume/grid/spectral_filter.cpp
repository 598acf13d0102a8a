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
    : implementation_(std::make_unique<Implementation>()) {
  Transform& transform = transform_of(grid, symmetry);
  implementation_->grid = &grid;
  implementation_->transform = &transform;
  auto& table = implementation_->factor;
  table.reserve(transform.theta(0).size() * transform.n_rows());
  for (int row = 0; row < transform.n_rows(); ++row) {
    const double theta_y = transform.theta(1)[transform.mode_y(row)];
    const double theta_z = transform.theta(2)[transform.mode_z(row)];
    for (const double theta_x : transform.theta(0))
      table.push_back(transform.normalisation() * factor({theta_x, theta_y, theta_z}));
  }
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
