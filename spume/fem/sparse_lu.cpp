#include "spume/fem/sparse_lu.hpp"

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spume/base/contract.hpp"

namespace spume::fem {

/// KLU needs no BLAS, and on the matrices of films (two rings of neighbours, up to some 10⁴ rows) it is
/// faster than the supernodal codes.
struct SparseLu::Factors {
  std::vector<int> column_offset, row;
  std::vector<double> value;
  klu_common common;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  Factors() { klu_defaults(&common); }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  ~Factors() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }

  /// Factorises with the order of pivots of the last time, a third of the work. False if there was no last
  /// time or the numbers grew more than KLU's own threshold for pivots (0.001) lets them: then the pivots
  /// must be chosen anew.
  bool refactorise() {
    if (numeric == nullptr) return false;
    return klu_refactor(column_offset.data(), row.data(), value.data(), symbolic, numeric, &common) &&
           common.status == KLU_OK &&
           klu_rgrowth(column_offset.data(), row.data(), value.data(), symbolic, numeric, &common) &&
           common.rgrowth > common.tol;
  }
};

SparseLu::SparseLu(std::span<const int> column_offset, std::span<const int> row)
    : factors_(std::make_unique<Factors>()) {
  expects(column_offset.size() > 1, "a matrix with at least one column");
  Factors& f = *factors_;
  f.column_offset.assign(column_offset.begin(), column_offset.end());
  f.row.assign(row.begin(), row.end());
  f.value.resize(row.size());
  f.symbolic = klu_analyze(static_cast<int>(column_offset.size()) - 1, f.column_offset.data(), f.row.data(),
                           &f.common);
  expects(f.symbolic != nullptr, "a sparse pattern with every diagonal entry");
}

SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factorise(std::span<const double> value) {
  Factors& f = *factors_;
  expects(value.size() == f.value.size(), "one value per entry of the pattern");
  if (!std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); })) return false;
  std::copy(value.begin(), value.end(), f.value.begin());
  if (f.refactorise()) return true;
  klu_free_numeric(&f.numeric, &f.common);
  f.numeric = klu_factor(f.column_offset.data(), f.row.data(), f.value.data(), f.symbolic, &f.common);
  return f.numeric != nullptr && f.common.status == KLU_OK;
}

void SparseLu::solve(std::span<double> right) {
  Factors& f = *factors_;
  expects(f.numeric != nullptr, "factorise() before solve()");
  klu_solve(f.symbolic, f.numeric, static_cast<int>(right.size()), 1, right.data(), &f.common);
}

}  // namespace spume::fem
