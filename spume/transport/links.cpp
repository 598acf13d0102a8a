#include "spume/transport/links.hpp"

#include "spume/base/union_find.hpp"

namespace spume::transport {

Links link_pieces(int n_old, int n_new, std::span<const std::pair<int, int>> same) {
  UnionFind classes(n_old + n_new);
  std::vector<char> linked(n_old + n_new, 0);
  for (const auto& [old_piece, new_piece] : same) {
    classes.join(old_piece, n_old + new_piece);
    linked[old_piece] = linked[n_old + new_piece] = 1;
  }
  Links links;
  std::vector<int> group_of_root(n_old + n_new, -1);
  const auto group_of = [&](int node) {
    if (!linked[node]) return -1;
    int& group = group_of_root[classes.find(node)];
    if (group < 0) group = links.n_groups++;
    return group;
  };
  for (int p = 0; p < n_old; ++p) links.group_of_old.push_back(group_of(p));
  for (int p = 0; p < n_new; ++p) links.group_of_new.push_back(group_of(n_old + p));
  return links;
}

std::vector<double> rescale_groups(const Links& links, const Shares& old_dofs,
                                   std::span<const double> old_volume, const Shares& new_dofs,
                                   std::span<double> new_volume) {
  std::vector<double> before(links.n_groups, 0), after(links.n_groups, 0), measure(links.n_groups, 0);
  for (std::size_t d = 0; d < old_volume.size(); ++d) {
    const int group = links.group_of_old[old_dofs.piece_of_dof[d]];
    if (group >= 0) before[group] += old_volume[d];
  }
  for (std::size_t d = 0; d < new_volume.size(); ++d) {
    const int group = links.group_of_new[new_dofs.piece_of_dof[d]];
    if (group < 0) continue;
    after[group] += new_volume[d];
    measure[group] += new_dofs.measure[d];
  }
  std::vector<double> factor(links.n_groups, 1);
  for (int g = 0; g < links.n_groups; ++g)
    if (after[g] > 0) factor[g] = before[g] / after[g];
  for (std::size_t d = 0; d < new_volume.size(); ++d) {
    const int group = links.group_of_new[new_dofs.piece_of_dof[d]];
    if (group < 0) continue;
    if (after[group] > 0)
      new_volume[d] *= factor[group];
    else if (measure[group] > 0)
      new_volume[d] = before[group] * (new_dofs.measure[d] / measure[group]);
  }
  return factor;
}

}  // namespace spume::transport
