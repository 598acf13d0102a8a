#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spume::config {

/// Number of letters to insert, delete, replace or swap with their neighbour that turns `a` into `b` (the
/// optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// The candidates that a writer of `name` most probably meant, best first, at most three: those with the same
/// last part in another section, else the nearest by edit distance when it is near enough; empty when none
/// is.
std::vector<std::string> nearest_names(const std::string& name, const std::vector<std::string>& candidates);

/// "; did you mean 'a'?" or "; did you mean 'a' or 'b'?" or nothing.
std::string did_you_mean(const std::vector<std::string>& names);

}  // namespace spume::config
