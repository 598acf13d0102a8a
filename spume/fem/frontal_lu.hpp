#pragma once

#include <span>
#include <vector>

namespace spume::fem {

/// LU factors of a large sparse matrix with a symmetric pattern, by the multifrontal method (Duff and Reid,
/// ACM Trans. Math. Softw. 9, 1983): columns of like pattern are eliminated together in small dense matrices.
/// The order is nested dissection, which on films needs O(n^{3/2}) operations. Rows are scaled by their
/// largest entry; pivots are sought within the columns that are eliminated together only, so that the pattern
/// of the factors is known beforehand. Where that is not enough, factorise() says so.
class FrontalLu {
 public:
  /// The pattern by columns, as SparseLu takes it, symmetric and with every diagonal entry.
  FrontalLu(std::span<const int> column_offset, std::span<const int> row);

  /// Factorises the matrix with these values, in the order of the pattern. False if a pivot is less than a
  /// millionth of what stands below it, or not all is finite.
  bool factorise(std::span<const double> value);

  /// Replaces the right side by the solution of A x = right, after factorise() was true.
  void solve(std::span<double> right);

 private:
  /// Columns that are eliminated together, and the rows in which they have entries: first themselves.
  struct Front {
    int first_column, n_columns;
    int n_rows;
    int first_row;        ///< in row_
    int parent;           ///< −1 for a root
    std::size_t factors;  ///< of the (n_rows × n_columns) block of L and U₁₁, then of U₁₂, in factor_
    int first_entry;      ///< in entry_
    std::size_t stack;    ///< what is on the stack of updates when it is reached, its children's taken off

    int n_below() const { return n_rows - n_columns; }
  };
  struct Entry {
    int value;          ///< which of the matrix's
    int row;            ///< of the matrix, for its scale
    std::size_t place;  ///< in the front
  };

  void analyse(std::span<const int> column_offset, std::span<const int> row);
  void link_fronts();
  void sort_entries(std::span<const int> column_offset, std::span<const int> row);
  void lay_out_memory();
  void assemble(std::size_t front, std::span<const double> value);
  bool eliminate(const Front& front);

  std::vector<int> order_, place_of_;  ///< the column of each place, and back
  std::vector<Front> front_;           ///< children before parents
  std::vector<int> row_;               ///< places
  std::vector<int> row_in_parent_;     ///< of each row below the columns of a front, in its parent
  std::vector<std::vector<int>> children_;
  std::vector<Entry> entry_;
  std::vector<int> matrix_row_;  ///< of each value
  std::vector<int> pivot_;       ///< row exchanged with each place, in its front
  std::vector<double> factor_, dense_, stack_, scale_, work_, below_;
};

}  // namespace spume::fem
