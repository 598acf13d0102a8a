#include "spume/fem/frontal_lu.hpp"

#include <cholmod.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "spume/base/contract.hpp"

namespace spume::fem {

namespace {

using Matrix = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using Vector = Eigen::Map<Eigen::VectorXd>;

Matrix block(double* first, int rows, int columns, int stride) {
  return {first, rows, columns, Eigen::OuterStride<>(stride)};
}

/// A symmetric pattern as CHOLMOD sees it: the upper triangle says all.
cholmod_sparse symmetric_pattern(std::vector<int>& column_offset, std::vector<int>& row) {
  cholmod_sparse pattern{};
  pattern.nrow = pattern.ncol = column_offset.size() - 1;
  pattern.nzmax = row.size();
  pattern.p = column_offset.data();
  pattern.i = row.data();
  pattern.stype = 1;
  pattern.itype = CHOLMOD_INT;
  pattern.xtype = CHOLMOD_PATTERN;
  pattern.dtype = CHOLMOD_DOUBLE;
  pattern.sorted = pattern.packed = 1;
  return pattern;
}

}  // namespace

FrontalLu::FrontalLu(std::span<const int> column_offset, std::span<const int> row) {
  analyse(column_offset, row);
  link_fronts();
  sort_entries(column_offset, row);
  lay_out_memory();
}

/// Order and fronts are those that CHOLMOD would take for a symmetric matrix.
void FrontalLu::analyse(std::span<const int> column_offset, std::span<const int> row) {
  std::vector<int> offsets(column_offset.begin(), column_offset.end()), rows(row.begin(), row.end());
  cholmod_sparse pattern = symmetric_pattern(offsets, rows);
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NESDIS;
  cholmod_factor* factor = cholmod_analyze(&pattern, &common);
  expects(factor != nullptr && factor->is_super != 0, "memory for the order of elimination");
  const auto* perm = static_cast<const int*>(factor->Perm);
  const auto* super = static_cast<const int*>(factor->super);
  const auto* pi = static_cast<const int*>(factor->pi);
  const auto* s = static_cast<const int*>(factor->s);
  const auto n = static_cast<int>(factor->n), n_fronts = static_cast<int>(factor->nsuper);
  order_.assign(perm, perm + n);
  row_.assign(s, s + pi[n_fronts]);
  for (int f = 0; f < n_fronts; ++f)
    front_.push_back({super[f], super[f + 1] - super[f], pi[f + 1] - pi[f], pi[f], -1, 0, 0, 0});
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  place_of_.resize(n);
  for (int place = 0; place < n; ++place) place_of_[order_[place]] = place;
}

/// A front hands what it leaves to the front of the first row below its columns.
void FrontalLu::link_fronts() {
  std::vector<int> front_of(order_.size());
  for (std::size_t f = 0; f < front_.size(); ++f)
    for (int c = 0; c < front_[f].n_columns; ++c) front_of[front_[f].first_column + c] = static_cast<int>(f);
  row_in_parent_.assign(row_.size(), -1);
  children_.resize(front_.size());
  for (std::size_t f = 0; f < front_.size(); ++f) {
    Front& front = front_[f];
    if (front.n_below() == 0) continue;
    front.parent = front_of[row_[front.first_row + front.n_columns]];
    children_[front.parent].push_back(static_cast<int>(f));
    const Front& parent = front_[front.parent];
    const auto first = row_.begin() + parent.first_row, last = first + parent.n_rows;
    for (int r = front.n_columns; r < front.n_rows; ++r)
      row_in_parent_[front.first_row + r] =
          static_cast<int>(std::lower_bound(first, last, row_[front.first_row + r]) - first);
  }
}

/// An entry belongs to the front that eliminates the first of its row and column.
void FrontalLu::sort_entries(std::span<const int> column_offset, std::span<const int> row) {
  std::vector<int> front_of(order_.size());
  for (std::size_t f = 0; f < front_.size(); ++f)
    for (int c = 0; c < front_[f].n_columns; ++c) front_of[front_[f].first_column + c] = static_cast<int>(f);
  std::vector<std::vector<Entry>> of_front(front_.size());
  for (std::size_t j = 0; j + 1 < column_offset.size(); ++j)
    for (int p = column_offset[j]; p < column_offset[j + 1]; ++p) {
      const int r = place_of_[row[p]], c = place_of_[j];
      const int f = front_of[std::min(r, c)];
      const Front& front = front_[f];
      const auto first = row_.begin() + front.first_row, last = first + front.n_rows;
      const auto local = [&](int place) {
        return static_cast<std::size_t>(std::lower_bound(first, last, place) - first);
      };
      of_front[f].push_back({p, row[p], local(r) + local(c) * static_cast<std::size_t>(front.n_rows)});
    }
  for (std::size_t f = 0; f < front_.size(); ++f) {
    front_[f].first_entry = static_cast<int>(entry_.size());
    entry_.insert(entry_.end(), of_front[f].begin(), of_front[f].end());
  }
  matrix_row_.assign(row.begin(), row.end());
}

void FrontalLu::lay_out_memory() {
  std::size_t factors = 0, largest = 0, stack = 0, highest = 0, below = 0;
  for (std::size_t f = 0; f < front_.size(); ++f) {
    Front& front = front_[f];
    const auto rows = static_cast<std::size_t>(front.n_rows),
               columns = static_cast<std::size_t>(front.n_columns);
    const auto left = static_cast<std::size_t>(front.n_below());
    front.factors = factors;
    factors += rows * columns + columns * left;
    largest = std::max(largest, rows * rows);
    for (int child : children_[f]) stack = std::min(stack, front_[child].stack);
    front.stack = stack;
    stack += left * left;
    highest = std::max(highest, stack);
    below = std::max(below, left);
  }
  factor_.resize(factors);
  dense_.resize(largest);
  stack_.resize(highest);
  below_.resize(below);
  pivot_.resize(order_.size());
  scale_.resize(order_.size());
  work_.resize(order_.size());
}

void FrontalLu::assemble(std::size_t f, std::span<const double> value) {
  const Front& front = front_[f];
  const auto n = static_cast<std::size_t>(front.n_rows);
  std::fill_n(dense_.begin(), n * n, 0.0);
  const std::size_t last = f + 1 < front_.size() ? front_[f + 1].first_entry : entry_.size();
  for (std::size_t e = front.first_entry; e < last; ++e)
    dense_[entry_[e].place] += scale_[entry_[e].row] * value[entry_[e].value];
  for (int c : children_[f]) {
    const Front& child = front_[c];
    const int left = child.n_below();
    const int* const place = row_in_parent_.data() + child.first_row + child.n_columns;
    const double* update = stack_.data() + child.stack;
    for (int j = 0; j < left; ++j, update += left) {
      double* const column = dense_.data() + n * static_cast<std::size_t>(place[j]);
      for (int i = 0; i < left; ++i) column[place[i]] += update[i];
    }
  }
}

bool FrontalLu::eliminate(const Front& front) {
  constexpr double largest_multiplier = 1e6;
  const int n = front.n_rows, k = front.n_columns, left = front.n_below();
  Matrix own = block(dense_.data(), k, k, n), lower = block(dense_.data() + k, left, k, n);
  double* const right = dense_.data() + static_cast<std::size_t>(n) * k;
  Matrix upper = block(right, k, left, n), rest = block(right + k, left, left, n);
  Eigen::Map<Eigen::VectorXi> pivots(pivot_.data() + front.first_column, k);
  Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>> in_place(own);
  const Eigen::PartialPivLU<decltype(in_place)> lu(in_place);
  if (!(own.diagonal().cwiseAbs().minCoeff() > 0)) return false;
  pivots = lu.permutationP().indices();
  if (left > 0) {
    upper = lu.permutationP() * upper;
    own.triangularView<Eigen::UnitLower>().solveInPlace(upper);
    own.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(lower);
    if (!(lower.cwiseAbs().maxCoeff() <= largest_multiplier)) return false;
    rest.noalias() -= lower * upper;
    block(stack_.data() + front.stack, left, left, left) = rest;
  }
  double* const factors = factor_.data() + front.factors;
  block(factors, n, k, n) = block(dense_.data(), n, k, n);
  block(factors + static_cast<std::size_t>(n) * k, k, left, k) = upper;
  return own.allFinite();
}

bool FrontalLu::factorise(std::span<const double> value) {
  expects(value.size() == matrix_row_.size(), "one value per entry of the pattern");
  std::ranges::fill(scale_, 0.0);
  for (std::size_t p = 0; p < value.size(); ++p)
    scale_[matrix_row_[p]] = std::max(scale_[matrix_row_[p]], std::abs(value[p]));
  for (double& s : scale_) {
    if (!(s > 0) || !std::isfinite(s)) return false;
    s = 1 / s;
  }
  for (std::size_t f = 0; f < front_.size(); ++f) {
    assemble(f, value);
    if (!eliminate(front_[f])) return false;
  }
  return true;
}

void FrontalLu::solve(std::span<double> right) {
  for (std::size_t place = 0; place < order_.size(); ++place)
    work_[place] = scale_[order_[place]] * right[order_[place]];
  for (const Front& front : front_) {
    const int n = front.n_rows, k = front.n_columns, left = front.n_below();
    double* const factors = factor_.data() + front.factors;
    double* const own = work_.data() + front.first_column;
    Vector x(own, k);
    const Eigen::PermutationMatrix<Eigen::Dynamic> pivots(
        Eigen::Map<const Eigen::VectorXi>(pivot_.data() + front.first_column, k));
    x = (pivots * x).eval();
    block(factors, k, k, n).triangularView<Eigen::UnitLower>().solveInPlace(x);
    Vector change(below_.data(), left);
    change.noalias() = block(factors + k, left, k, n) * x;
    for (int r = 0; r < left; ++r) work_[row_[front.first_row + k + r]] -= change(r);
  }
  for (auto front = front_.rbegin(); front != front_.rend(); ++front) {
    const int n = front->n_rows, k = front->n_columns, left = front->n_below();
    double* const factors = factor_.data() + front->factors;
    Vector x(work_.data() + front->first_column, k), known(below_.data(), left);
    for (int r = 0; r < left; ++r) known(r) = work_[row_[front->first_row + k + r]];
    x.noalias() -= block(factors + static_cast<std::size_t>(n) * k, k, left, k) * known;
    block(factors, k, k, n).triangularView<Eigen::Upper>().solveInPlace(x);
  }
  for (std::size_t place = 0; place < order_.size(); ++place) right[order_[place]] = work_[place];
}

}  // namespace spume::fem
