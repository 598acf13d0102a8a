#include "spume/config/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "spume/base/error.hpp"
#include "spume/config/cross_checks.hpp"
#include "spume/config/entries.hpp"
#include "spume/config/keys.hpp"
#include "spume/config/nearest.hpp"
#include "spume/config/problems.hpp"
#include "spume/config/read_value.hpp"
#include "spume/config/text.hpp"

namespace spume::config {

namespace {

using simulation::Case;

template <class Record>
const Key<Record>* find_key(const std::vector<Key<Record>>& keys, const std::string& name) {
  const auto found = std::ranges::find(keys, name, &Key<Record>::name);
  return found == keys.end() ? nullptr : &*found;
}

template <class Record>
std::vector<std::string> names_of(const std::vector<Key<Record>>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.push_back(key.name);
  return names;
}

/// "; the keys of [gas] are density, viscosity": for those who are too far off for a nearest key.
template <class Record>
std::string keys_of_section(const std::vector<Key<Record>>& keys, const std::string& section) {
  std::vector<std::string> leaves;
  for (const auto& key : keys)
    if (section_of(key.name) == section) leaves.push_back(leaf_of(key.name));
  if (leaves.empty()) return {};
  return "; " + (section.empty() ? "the top level" : "[" + section + "]") + " has " + joined(leaves);
}

std::string unknown_section(const std::string& name) {
  std::vector<std::string> candidates{bubble_list};
  for (const auto& section : sections())
    if (!section.name.empty()) candidates.push_back(section.name);
  const std::string hint = did_you_mean(nearest_names(name, candidates));
  return "unknown section '" + name + "'" +
         (hint.empty() ? "; the sections are " + joined(candidates) : hint);
}

std::string unknown_key(const std::string& name) {
  std::vector<std::string> candidates = names_of(case_keys());
  candidates.push_back(bubble_list);
  const std::string hint = did_you_mean(nearest_names(name, candidates));
  return "unknown key '" + name + "'" +
         (hint.empty() ? keys_of_section(case_keys(), section_of(name)) : hint);
}

/// What is wrong with an entry that is no key of the table.
std::string not_a_key(const std::string& name, const toml::node& value) {
  for (const auto& section : sections())
    if (name == section.name) return "'" + name + "' is a section: write [" + name + "] and its keys below";
  return value.is_table() || value.is_array_of_tables() ? unknown_section(name) : unknown_key(name);
}

/// The keys that a bubble of this shape has, of those that depend on the shape.
std::string size_key(BubbleEntry::Shape shape) {
  return shape == BubbleEntry::Shape::Sphere ? "foam.bubble.radius" : "foam.bubble.semi_axes";
}

/// What a bubble lacks, or has that does not go with its shape.
void check_bubble_keys(const BubbleEntry& bubble, const std::set<std::string>& given,
                       const std::string& which, const Place& place, Problems& problems) {
  const bool sphere = bubble.shape == BubbleEntry::Shape::Sphere;
  const std::string size = size_key(bubble.shape);
  const std::string other = size_key(sphere ? BubbleEntry::Shape::Ellipsoid : BubbleEntry::Shape::Sphere);
  for (const auto& key : bubble_keys())
    if (key.required && !given.contains(key.name))
      problems.add(place, which + " has no '" + leaf_of(key.name) + "' (" + key.meaning + ")");
  if (!given.contains("foam.bubble.shape")) return;
  const std::string shape = sphere ? "a sphere" : "an ellipsoid";
  if (!given.contains(size)) problems.add(place, which + ", " + shape + ", has no '" + leaf_of(size) + "'");
  if (given.contains(other))
    problems.add(place, which + " is " + shape + ", which has '" + leaf_of(size) + "' and no '" +
                            leaf_of(other) + "'");
}

simulation::BubbleShape read_bubble(const toml::table& table, const std::string& which, const Place& place,
                                    Problems& problems) {
  BubbleEntry bubble;
  std::set<std::string> given;
  for (const auto& [leaf, value] : table) {
    const std::string name = bubble_list + "." + std::string(leaf.str());
    const auto place_here = [&](const toml::source_region& region) {
      return place.line == 0 ? place : place_in(place.source, region);
    };
    if (const auto* key = find_key(bubble_keys(), name)) {
      if (const auto complaint = read_value(*key, value, bubble))
        problems.add(place_here(value.source()), which + ": " + *complaint);
      given.insert(name);
      continue;
    }
    const std::string hint = did_you_mean(nearest_names(name, names_of(bubble_keys())));
    problems.add(
        place_here(leaf.source()),
        "unknown key '" + name + "'" + (hint.empty() ? keys_of_section(bubble_keys(), bubble_list) : hint));
  }
  check_bubble_keys(bubble, given, which, place, problems);
  const double r = bubble.radius;
  return {bubble.center, bubble.shape == BubbleEntry::Shape::Sphere ? Vec3{r, r, r} : bubble.semi_axes};
}

void read_bubbles(const Entry& entry, Case& run_case, std::vector<Place>& places, Problems& problems) {
  const toml::array* array = entry.value->as_array();
  if (array == nullptr || !array->is_array_of_tables()) {
    problems.add(entry.place,
                 "'" + bubble_list + "' must be a list of tables, one [[foam.bubble]] for each bubble");
    return;
  }
  for (const toml::node& element : *array) {
    const Place place = entry.place.line == 0 ? entry.place : place_in(entry.place.source, element.source());
    const std::string which = fmt::format("bubble {}", run_case.foam.bubble.size() + 1);
    run_case.foam.bubble.push_back(read_bubble(*element.as_table(), which, place, problems));
    places.push_back(place);
  }
}

/// A relative name of a file starts at the folder of the case file, or, on the command line, where the
/// program runs; from now on it is absolute, so that the resolved case can stand in any folder.
void resolve_file(const Entries& entries, const std::string& key, const std::string& source,
                  std::string& name) {
  const Entry* entry = entries.find(key);
  if (entry == nullptr) return;
  const std::filesystem::path file = name;
  const auto folder =
      entry->place.line == 0 ? std::filesystem::path() : std::filesystem::path(source).parent_path();
  name = std::filesystem::absolute(folder / file).lexically_normal().string();
}

/// Films of a file need no grid; the least one stands in for it, without a periodic direction.
void leave_out_domain(Case& run_case) {
  const int n = 16;
  run_case.box = {
      {0, 0, 0}, {1, 1, 1}, {n, n, n}, {grid::Boundary::Wall, grid::Boundary::Wall, grid::Boundary::Wall}};
}

void check_required(const Case& run_case, const Entries& entries, Problems& problems) {
  for (const auto& key : case_keys())
    if (key.required && !(run_case.foam.films && section_of(key.name) == "domain") &&
        entries.find(key.name) == nullptr)
      problems.add(entries.place_of(key.name), "missing key '" + key.name + "' (" + key.meaning + ")");
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(file.string() + ": is a folder, not a case file");
  std::ifstream stream(file);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream)
    throw InputError(file.string() + ": cannot be read: " + std::generic_category().message(errno));
  return text.str();
}

Case parse_case(const std::string& text, const std::string& source, const std::vector<std::string>& options) {
  Entries entries(text, source);
  for (const auto& option : options) entries.set(option);

  Case run_case;
  Problems problems;
  std::vector<Place> bubble_places;
  for (const auto& section : sections())
    if (section.create != nullptr && entries.has_section(section.name)) section.create(run_case);
  if (run_case.foam.films) leave_out_domain(run_case);
  for (const auto& [name, entry] : entries.all()) {
    if (name == bubble_list) {
      read_bubbles(entry, run_case, bubble_places, problems);
    } else if (const auto* key = find_key(case_keys(), name)) {
      if (const auto complaint = read_value(*key, *entry.value, run_case))
        problems.add(entry.place, *complaint);
    } else {
      problems.add(entry.key_place, not_a_key(name, *entry.value));
    }
  }
  if (run_case.foam.labels) resolve_file(entries, "foam.labels.file", source, run_case.foam.labels->file);
  if (run_case.foam.films) resolve_file(entries, "foam.films.file", source, run_case.foam.films->file);
  check_required(run_case, entries, problems);
  // What contradicts itself can only be told from values that are right.
  if (problems.none()) cross_check(run_case, entries, bubble_places, problems);
  problems.throw_if_any();
  // One key says it for the steps and for the reconstructions between them.
  run_case.reconstruct.conserve_volumes = run_case.rearrangement.conserve_volumes;
  return run_case;
}

}  // namespace spume::config
