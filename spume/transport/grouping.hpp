#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace spume::transport {

/// The members of each of a number of groups, in increasing order, stored one group after another.
struct Grouping {
  std::vector<int> offset;  ///< group g holds member[offset[g] … offset[g+1])
  std::vector<int> member;

  std::span<const int> operator[](int group) const {
    return {member.data() + offset[group], static_cast<std::size_t>(offset[group + 1] - offset[group])};
  }
};

/// Sorts the members 0 … n−1 by `group_of`; members of group −1 are left out.
Grouping group_members(int n_groups, std::span<const int> group_of);

}  // namespace spume::transport
