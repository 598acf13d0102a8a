#include "spume/drainage/lamella_shares.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spume::drainage {

double lamella_cost(int n_film_dofs) {
  return std::pow(n_film_dofs, 1.3);
}

std::vector<int> share_out(std::span<const double> cost, int n_ranks) {
  std::vector<int> order(cost.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return cost[a] > cost[b]; });
  std::vector<double> load(n_ranks, 0.0);
  std::vector<int> rank(cost.size());
  for (int piece : order) {
    const auto least = std::min_element(load.begin(), load.end());
    *least += cost[piece];
    rank[piece] = static_cast<int>(least - load.begin());
  }
  return rank;
}

LamellaShares::LamellaShares(const mesh::Topology& topology, const parallel::Communicator& communicator)
    : communicator_(communicator) {
  std::vector<int> size(topology.n_lamellae(), 0);
  for (const auto& dof : topology.film_dof) ++size[dof.lamella];
  std::vector<double> cost;
  for (int n : size) cost.push_back(lamella_cost(n));
  const std::vector<int> rank = share_out(cost, communicator.size());

  std::vector<double> load(communicator.size(), 0.0);
  offset_.assign(communicator.size() + 1, 0);
  for (int l = 0; l < topology.n_lamellae(); ++l) {
    if (rank[l] == communicator.rank()) own_.push_back(l);
    load[rank[l]] += cost[l];
    offset_[rank[l] + 1] += size[l];
  }
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
  const double sum = std::accumulate(load.begin(), load.end(), 0.0);
  if (sum > 0) imbalance_ = *std::max_element(load.begin(), load.end()) / sum * communicator.size();

  film_dof_.resize(topology.film_dof.size());
  packed_.resize(topology.film_dof.size());
  std::vector<int> next(offset_.begin(), offset_.end() - 1);
  for (std::size_t d = 0; d < film_dof_.size(); ++d)
    film_dof_[next[rank[topology.film_dof[d].lamella]]++] = static_cast<int>(d);
}

void LamellaShares::exchange(std::span<double> of_film_dofs) {
  if (communicator_.size() == 1) return;
  const int first = offset_[communicator_.rank()], last = offset_[communicator_.rank() + 1];
  for (int n = first; n < last; ++n) packed_[n] = of_film_dofs[film_dof_[n]];
  communicator_.all_gather(std::span(packed_), offset_);
  for (std::size_t n = 0; n < packed_.size(); ++n) of_film_dofs[film_dof_[n]] = packed_[n];
}

}  // namespace spume::drainage
