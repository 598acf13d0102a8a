#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "spume/fem/sparse_lu.hpp"

namespace spume::fem {

/// A direct solver for matrices whose unknowns stand in chains that meet at junctions, as those of Plateau
/// borders do. The inside of each chain is eliminated from one end to the other, in linear time, and leaves a
/// sparse matrix of the junctions. The pattern is analysed once, values are factorised often; apart from the
/// matrix of the junctions nothing is allocated for that.
///
/// Elimination along a chain has no pivots to choose. Where the rows or columns are those of an M-matrix, as
/// with fluxes M − sJ that grow with the unknown they leave and fall with the one they enter, every
/// elimination leaves such a matrix, pivots stay above what is stored (M) and no multiplier exceeds one.
/// Other matrices are watched: factorise() refuses those that would lose more than six digits. What M is to
/// sJ bounds what is left of a sum in any of them: at sJ/M = 10¹³ it is good to three digits.
class NetworkLu {
 public:
  /// Unknowns 0 … n_unknowns − 1 and the pairs that are coupled. A pair may occur more than once, chains may
  /// be rings, end freely or be single unknowns.
  NetworkLu(int n_unknowns, std::span<const std::array<int, 2>> link);

  /// Factorises the matrix with this diagonal and coupling[l] = {entry in row link[l][0] and column
  /// link[l][1], the transposed one}; those of links between the same two add up. False if the matrix is
  /// singular, not finite or in need of pivots; then solve() must not be called.
  bool factorise(std::span<const double> diagonal, std::span<const std::array<double, 2>> coupling);

  /// Replaces the right side by the solution of A x = right.
  void solve(std::span<double> right);

  /// Unknowns that are not inside chains: where three or more links meet, one of each ring and an end of each
  /// chain that meets no junction.
  int n_junctions() const { return static_cast<int>(junction_.size()); }

 private:
  /// Where an entry of the matrix of the junctions is stored, −1 for none, at a free end.
  struct Corner {
    int start = -1, end = -1, start_end = -1, end_start = -1;  ///< row, then column
  };
  struct Chain {
    int start, end;   ///< junctions at its ends, the latter −1 where it ends freely
    int first, last;  ///< its unknowns are unknown_[first … last)
    int first_link;   ///< its links are link_[first_link … first_link + last − first]
    Corner schur;
  };
  /// What elimination leaves of one unknown. Rows are divided by the pivot.
  struct Row {
    double inverse;            ///< of the pivot
    double next, start;        ///< entries in the columns of the next unknown and of the start of the chain
    double to_next, to_start;  ///< multiples of this row that were taken from theirs
  };

  void find_chains(int n_unknowns, std::span<const std::array<int, 2>> link);
  void build_junction_pattern();
  bool eliminate(const Chain& chain, std::span<const double> diagonal, const double* coupling);

  std::size_t n_links_;
  std::vector<int> junction_;  ///< its unknown
  std::vector<Chain> chain_;
  std::vector<int> unknown_;   ///< inside chains, one chain after the other
  std::vector<int> link_;      ///< along chains: 2 × link + 1 if it points along the chain, + 0 if against
  std::vector<Row> row_;       ///< of each of unknown_
  std::vector<double> right_;  ///< the same
  std::vector<int> diagonal_of_junction_;  ///< where its entry is in schur_
  std::vector<double> schur_, right_of_junctions_;
  std::optional<SparseLu> junction_lu_;  ///< none without unknowns
};

}  // namespace spume::fem
