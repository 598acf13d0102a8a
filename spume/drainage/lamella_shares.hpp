#pragma once

#include <span>
#include <vector>

#include "spume/mesh/topology.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::drainage {

/// Estimated time of a drainage step of a lamella, in proportion: n^1.3 for n film dofs, as measured with
/// bench/drainage.cpp for assembly, factorisation and solves together.
double lamella_cost(int n_film_dofs);

/// Ranks of pieces of work: the costliest first, each to the rank that has the least so far; the lowest of
/// such ranks, and the first of equal pieces. The largest sum is at most 4/3 of the least possible (Graham,
/// SIAM J. Appl. Math. 17, 1969).
std::vector<int> share_out(std::span<const double> cost, int n_ranks);

/// Whole lamellae shared out to ranks: each is assembled, factorised and solved by one of them.
/// Paper: Sec. 3.5.2, for lamellae. The borders are one system, far smaller than that of the largest lamella,
/// and every rank solves it: it takes η of all rims and gives λ to all.
class LamellaShares {
 public:
  LamellaShares(const mesh::Topology& topology, const parallel::Communicator& communicator);

  const parallel::Communicator& communicator() const { return communicator_; }
  /// The lamellae of this rank, increasing.
  const std::vector<int>& own() const { return own_; }
  /// Estimated cost of the rank that has the most, over the mean: the time of a step is this over the number
  /// of ranks. 1 without lamellae.
  double imbalance() const { return imbalance_; }

  /// Gives every rank the values of all film dofs, of which each has those of its own lamellae. One message
  /// to each rank. Collective.
  void exchange(std::span<double> of_film_dofs);

 private:
  parallel::Communicator communicator_;
  std::vector<int> own_;
  double imbalance_ = 1;
  std::vector<int> film_dof_;   ///< all, sorted by the rank that has them
  std::vector<int> offset_;     ///< of the part of each rank in film_dof_
  std::vector<double> packed_;  ///< values in the order of film_dof_
};

}  // namespace spume::drainage
