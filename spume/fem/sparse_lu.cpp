#include "spume/fem/sparse_lu.hpp"

#include <umfpack.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <vector>

#include "spume/base/contract.hpp"

namespace spume::fem {

/// The multifrontal method of UMFPACK (Davis, ACM Trans. Math. Softw. 30, 2004), with pivots preferred on the
/// diagonal and the order of elimination by nested dissection (METIS), which on films needs O(n^{3/2})
/// operations.
struct SparseLu::Factors {
  std::vector<int> column_offset, row;
  std::array<double, UMFPACK_CONTROL> control{};
  void* symbolic = nullptr;
  void* numeric = nullptr;
  std::vector<double> solution, work;
  std::vector<int> index_work;

  Factors() {
    umfpack_di_defaults(control.data());
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    control[UMFPACK_IRSTEP] = 0;  // no iterative refinement
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  ~Factors() {
    forget_values();
    umfpack_di_free_symbolic(&symbolic);
  }

  void forget_values() { umfpack_di_free_numeric(&numeric); }
};

SparseLu::SparseLu(std::span<const int> column_offset, std::span<const int> row)
    : factors_(std::make_unique<Factors>()) {
  expects(column_offset.size() > 1, "a matrix with at least one column");
  Factors& f = *factors_;
  f.column_offset.assign(column_offset.begin(), column_offset.end());
  f.row.assign(row.begin(), row.end());
  const auto n = static_cast<int>(column_offset.size()) - 1;
  const int status = umfpack_di_symbolic(n, n, f.column_offset.data(), f.row.data(), nullptr, &f.symbolic,
                                         f.control.data(), nullptr);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  expects(status == UMFPACK_OK, "a sparse pattern by columns with increasing rows");
  f.solution.resize(n);
  f.work.resize(n);
  f.index_work.resize(n);
}

SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factorise(std::span<const double> value) {
  Factors& f = *factors_;
  expects(value.size() == f.row.size(), "one value per entry of the pattern");
  f.forget_values();
  if (!std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); })) return false;
  const int status = umfpack_di_numeric(f.column_offset.data(), f.row.data(), value.data(), f.symbolic,
                                        &f.numeric, f.control.data(), nullptr);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (status != UMFPACK_OK) f.forget_values();
  return status == UMFPACK_OK;
}

void SparseLu::solve(std::span<double> right) {
  Factors& f = *factors_;
  expects(f.numeric != nullptr, "factorise() before solve()");
  expects(right.size() == f.solution.size(), "one entry per row");
  // Without iterative refinement the matrix itself is not asked for.
  umfpack_di_wsolve(UMFPACK_A, nullptr, nullptr, nullptr, f.solution.data(), right.data(), f.numeric,
                    f.control.data(), nullptr, f.index_work.data(), f.work.data());
  std::copy(f.solution.begin(), f.solution.end(), right.begin());
}

}  // namespace spume::fem
