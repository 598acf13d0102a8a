#include "spume/config/describe.hpp"

#include <vector>

#include "spume/base/error.hpp"
#include "spume/config/keys.hpp"
#include "spume/config/nearest.hpp"
#include "spume/config/text.hpp"
#include "spume/config/value_text.hpp"

namespace spume::config {

namespace {

template <class Record>
std::string section_text(const std::string& heading, const std::string& meaning, const std::string& section,
                         const std::vector<Key<Record>>& keys, Record& defaults, bool has_defaults) {
  std::vector<std::vector<std::string>> rows{{"key", "default", "unit", "range", "symbol", "meaning"}};
  for (const auto& key : keys) {
    if (section_of(key.name) != section) continue;
    std::string value = key.required ? "required" : has_defaults ? value_text(key.kind, defaults) : "";
    if (value.empty()) value = "–";
    rows.push_back({leaf_of(key.name), value, key.unit, range_text(key.kind), key.symbol, key.meaning});
  }
  return heading + "  " + meaning + "\n" + aligned(rows) + "\n";
}

}  // namespace

std::string describe(const std::string& section) {
  simulation::Case defaults;
  BubbleEntry no_defaults;
  std::string text;
  std::vector<std::string> names{bubble_list};
  for (const auto& s : sections()) {
    if (!s.name.empty()) names.push_back(s.name);
    if (!section.empty() && section != s.name) continue;
    const std::string heading = s.name.empty() ? "top level" : "[" + s.name + "]";
    text += section_text(heading, s.meaning, s.name, case_keys(), defaults, true);
  }
  if (section.empty() || section == bubble_list || section == section_of(bubble_list))
    text += section_text("[[" + bubble_list + "]]", "one bubble; as many as wanted", bubble_list,
                         bubble_keys(), no_defaults, false);
  if (text.empty())
    throw InputError("no section '" + section + "'" + did_you_mean(nearest_names(section, names)));
  return text;
}

}  // namespace spume::config
