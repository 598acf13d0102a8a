#include "spume/config/nearest.hpp"

#include <algorithm>
#include <utility>

#include "spume/config/key.hpp"

namespace spume::config {

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<int> before_last(n + 1), last(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[n];
}

std::vector<std::string> nearest_names(const std::string& name, const std::vector<std::string>& candidates) {
  constexpr std::size_t most = 3;
  const std::string leaf = leaf_of(name);
  // A name of n letters with more than n/3 of them wrong is another word.
  const auto allowed = [](const std::string& word) { return std::max(1, static_cast<int>(word.size()) / 3); };

  std::vector<std::pair<int, std::string>> near;
  for (const auto& candidate : candidates) {
    const int of_leaf = edit_distance(leaf, leaf_of(candidate));
    const bool same_section = section_of(name) == section_of(candidate);
    if (same_section ? of_leaf <= allowed(leaf) : of_leaf == 0)
      near.emplace_back(of_leaf, candidate);
    else if (edit_distance(name, candidate) <= allowed(leaf))
      near.emplace_back(edit_distance(name, candidate), candidate);
  }
  std::ranges::stable_sort(near, {}, &std::pair<int, std::string>::first);
  std::vector<std::string> names;
  for (const auto& [distance, candidate] : near)
    if (distance == near.front().first && names.size() < most) names.push_back(candidate);
  return names;
}

std::string did_you_mean(const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string text = "; did you mean '" + names.front() + "'";
  for (std::size_t n = 1; n < names.size(); ++n)
    text += (n + 1 == names.size() ? " or '" : ", '") + names[n] + "'";
  return text + "?";
}

}  // namespace spume::config
