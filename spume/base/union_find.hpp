#pragma once

#include <numeric>
#include <vector>

namespace spume {

/// Disjoint sets of the integers 0 … n−1. The representative of a set is its smallest member, so the result
/// does not depend on the order of the joins.
class UnionFind {
 public:
  explicit UnionFind(int n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int find(int a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }

  void join(int a, int b) {
    a = find(a);
    b = find(b);
    if (a < b)
      parent_[b] = a;
    else
      parent_[a] = b;
  }

  /// Number of sets, and for each member the number of its set, counted in the order of representatives.
  int number(std::vector<int>& set_of) {
    int n_sets = 0;
    set_of.assign(parent_.size(), -1);
    for (int a = 0; a < static_cast<int>(parent_.size()); ++a) {
      const int root = find(a);
      if (set_of[root] < 0) set_of[root] = n_sets++;
      set_of[a] = set_of[root];
    }
    return n_sets;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace spume
