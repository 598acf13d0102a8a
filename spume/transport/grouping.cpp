#include "spume/transport/grouping.hpp"

namespace spume::transport {

Grouping group_members(int n_groups, std::span<const int> group_of) {
  Grouping grouping;
  grouping.offset.assign(n_groups + 1, 0);
  for (int g : group_of)
    if (g >= 0) ++grouping.offset[g + 1];
  for (int g = 0; g < n_groups; ++g) grouping.offset[g + 1] += grouping.offset[g];
  grouping.member.resize(grouping.offset[n_groups]);
  std::vector<int> next(grouping.offset.begin(), grouping.offset.end() - 1);
  for (std::size_t m = 0; m < group_of.size(); ++m)
    if (group_of[m] >= 0) grouping.member[next[group_of[m]]++] = static_cast<int>(m);
  return grouping;
}

}  // namespace spume::transport
