#pragma once

#include <span>
#include <utility>
#include <vector>

namespace spume::transport {

/// Which pieces (lamellae, or borders) of an old and a new mesh are the same film: the connected parts of the
/// graph of old and new pieces that lie on each other. Pieces without any link belong to no group.
struct Links {
  int n_groups = 0;
  std::vector<int> group_of_old, group_of_new;  ///< −1: no link
};

/// Groups pieces by pairs (old piece, new piece).
Links link_pieces(int n_old, int n_new, std::span<const std::pair<int, int>> same);

/// One side of a rescaling.
struct Shares {
  std::span<const int> piece_of_dof;
  std::span<const double> measure;  ///< lumped area [m²] or length [m] of each dof
};

/// Scales the new volumes of each group so that the group holds what it held before: this conserves. A group
/// whose new volumes are all zero gets its liquid evenly over its measure. Gives each group's factor; 1 where
/// there was nothing.
std::vector<double> rescale_groups(const Links& links, const Shares& old_dofs,
                                   std::span<const double> old_volume, const Shares& new_dofs,
                                   std::span<double> new_volume);

}  // namespace spume::transport
