#include "spume/fem/network_lu.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "spume/base/contract.hpp"

namespace spume::fem {
namespace {

/// Least pivot over the sum of what it came from and what it divides: below it more than six digits may go.
constexpr double least_pivot = 1e-6;

using Links = std::span<const std::array<int, 2>>;

/// Links by unknown; one from an unknown to itself twice.
std::vector<std::vector<int>> links_of(int n_unknowns, Links link) {
  std::vector<std::vector<int>> of(n_unknowns);
  for (std::size_t l = 0; l < link.size(); ++l)
    for (int u : link[l]) {
      expects(u >= 0 && u < n_unknowns, "links between unknowns");
      of[u].push_back(static_cast<int>(l));
    }
  return of;
}

}  // namespace

NetworkLu::NetworkLu(int n_unknowns, Links link) : n_links_(link.size()) {
  find_chains(n_unknowns, link);
  build_junction_pattern();
  row_.resize(unknown_.size());
  right_.resize(unknown_.size());
  right_of_junctions_.resize(junction_.size());
}

void NetworkLu::find_chains(int n_unknowns, Links link) {
  const auto links = links_of(n_unknowns, link);
  std::vector<int> junction_of(n_unknowns, -1);
  std::vector<bool> unknown_done(n_unknowns, false), link_done(link.size(), false);
  const auto add_junction = [&](int u) {
    junction_of[u] = n_junctions();
    unknown_done[u] = true;
    junction_.push_back(u);
  };
  const auto follow = [&](int at, int next_link) {  // a chain from a junction
    Chain chain{
        junction_of[at], -1, static_cast<int>(unknown_.size()), 0, static_cast<int>(link_.size()), {}};
    while (!link_done[next_link]) {
      link_done[next_link] = true;
      const bool along = link[next_link][0] == at;
      link_.push_back(2 * next_link + (along ? 1 : 0));
      at = link[next_link][along ? 1 : 0];
      chain.end = junction_of[at];
      if (chain.end >= 0) break;
      unknown_.push_back(at);
      unknown_done[at] = true;
      for (int l : links[at])
        if (!link_done[l]) next_link = l;
    }
    if (chain.end < 0) link_.push_back(-1);
    chain.last = static_cast<int>(unknown_.size());
    chain_.push_back(chain);
  };
  const auto follow_all = [&](int u) {
    for (int l : links[u])
      if (!link_done[l]) follow(u, l);
  };
  for (int u = 0; u < n_unknowns; ++u)
    if (links[u].size() > 2) add_junction(u);
  for (std::size_t j = 0; j < junction_.size(); ++j) follow_all(junction_[j]);
  // What meets no junction gets one. The last pivot of a free chain would be all that the chain stores, the
  // difference of numbers as much larger as the matrix is stiff, and look like one that needs exchanging.
  const auto follow_from = [&](auto is_first) {
    for (int u = 0; u < n_unknowns; ++u)
      if (!unknown_done[u] && is_first(u)) {
        add_junction(u);
        follow_all(u);
      }
  };
  follow_from([&](int u) { return links[u].size() < 2; });
  follow_from([](int) { return true; });  // rings
}

void NetworkLu::build_junction_pattern() {
  const int n = n_junctions();
  if (n == 0) return;
  std::vector<std::set<int>> rows(n);  // of each column
  for (int j = 0; j < n; ++j) rows[j].insert(j);
  for (const Chain& chain : chain_) {
    if (chain.end < 0) continue;
    rows[chain.start].insert(chain.end);
    rows[chain.end].insert(chain.start);
  }
  std::vector<int> offset{0}, row;
  for (const auto& column : rows) {
    row.insert(row.end(), column.begin(), column.end());
    offset.push_back(static_cast<int>(row.size()));
  }
  const auto position = [&](int i, int j) {
    if (i < 0 || j < 0) return -1;  // of a free end
    return static_cast<int>(std::lower_bound(row.begin() + offset[j], row.begin() + offset[j + 1], i) -
                            row.begin());
  };
  for (int j = 0; j < n; ++j) diagonal_of_junction_.push_back(position(j, j));
  for (Chain& chain : chain_)
    chain.schur = {position(chain.start, chain.start), position(chain.end, chain.end),
                   position(chain.start, chain.end), position(chain.end, chain.start)};
  schur_.resize(row.size());
  junction_lu_.emplace(offset, row);
}

bool NetworkLu::factorise(std::span<const double> diagonal, std::span<const std::array<double, 2>> coupling) {
  expects(diagonal.size() == unknown_.size() + junction_.size(), "one diagonal entry per unknown");
  expects(coupling.size() == n_links_, "one pair of entries per link");
  std::fill(schur_.begin(), schur_.end(), 0.0);
  for (std::size_t j = 0; j < junction_.size(); ++j)
    schur_[diagonal_of_junction_[j]] = diagonal[junction_[j]];
  const double* entry = coupling.empty() ? nullptr : coupling.front().data();
  for (const Chain& chain : chain_)
    if (!eliminate(chain, diagonal, entry)) return false;
  return !junction_lu_ || junction_lu_->factorise(schur_);
}

/// Eliminates the unknowns of a chain, each of which couples the next one to the start of the chain.
bool NetworkLu::eliminate(const Chain& chain, std::span<const double> diagonal, const double* coupling) {
  const int* link = link_.data() + chain.first_link;
  // Entries of the row that follows in the column of the start, and of the row of the start in its column.
  double start = coupling[*link], from_start = coupling[*link ^ 1];
  double at_start = 0, taken = 0;  // from the diagonals of the start and of what follows
  for (int k = chain.first; k < chain.last; ++k) {
    ++link;
    const double below = *link < 0 ? 0 : coupling[*link], next = *link < 0 ? 0 : coupling[*link ^ 1];
    const double whole = diagonal[unknown_[k]], pivot = whole - taken;
    const double size = std::abs(whole) + std::abs(taken) + std::abs(below) + std::abs(from_start);
    if (!(std::abs(pivot) >= least_pivot * size) || !(size > 0) || !std::isfinite(size)) return false;
    const double inverse = 1 / pivot;
    const Row row{inverse, next * inverse, start * inverse, below * inverse, from_start * inverse};
    row_[k] = row;
    at_start += row.to_start * start;
    taken = below * next * inverse;
    start *= -row.to_next;
    from_start = -row.to_start * next;
  }
  schur_[chain.schur.start] -= at_start;
  if (chain.schur.end >= 0) schur_[chain.schur.end] -= taken;
  if (chain.schur.end_start >= 0) {
    schur_[chain.schur.end_start] += start;
    schur_[chain.schur.start_end] += from_start;
  }
  return true;
}

void NetworkLu::solve(std::span<double> right) {
  expects(right.size() == unknown_.size() + junction_.size(), "one entry per row");
  for (std::size_t j = 0; j < junction_.size(); ++j) right_of_junctions_[j] = right[junction_[j]];
  for (const Chain& chain : chain_) {
    double of_start = 0, carried = 0;
    for (int k = chain.first; k < chain.last; ++k) {
      const double value = right[unknown_[k]] - carried;
      right_[k] = value;
      of_start += row_[k].to_start * value;
      carried = row_[k].to_next * value;
    }
    right_of_junctions_[chain.start] -= of_start;
    if (chain.end >= 0) right_of_junctions_[chain.end] -= carried;
  }
  if (junction_lu_) junction_lu_->solve(right_of_junctions_);
  for (std::size_t j = 0; j < junction_.size(); ++j) right[junction_[j]] = right_of_junctions_[j];
  for (const Chain& chain : chain_) {
    const double at_start = right_of_junctions_[chain.start];
    double next = chain.end < 0 ? 0 : right_of_junctions_[chain.end];
    for (int k = chain.last - 1; k >= chain.first; --k) {
      const Row& row = row_[k];
      next = row.inverse * right_[k] - row.start * at_start - row.next * next;
      right[unknown_[k]] = next;
    }
  }
}

}  // namespace spume::fem
