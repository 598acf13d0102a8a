#pragma once

#include <toml++/toml.h>

#include <deque>
#include <map>
#include <string>

#include "spume/config/problems.hpp"

namespace spume::config {

/// A key that the user wrote.
struct Entry {
  const toml::node* value;
  Place place;      ///< of the value
  Place key_place;  ///< of the key
};

/// What the user wrote, in the case file and in `--set` options, by full name ("gas.density"). Tables are
/// opened where they are sections; everything else is an entry with its value, whatever that is.
class Entries {
 public:
  /// Throws InputError with the place when `text` is not TOML.
  Entries(const std::string& text, const std::string& source);
  Entries(const Entries&) = delete;
  Entries& operator=(const Entries&) = delete;

  /// Takes over the value of "section.key=value"; a value of one bare word is text. Throws InputError naming
  /// the option.
  void set(const std::string& option);

  const std::map<std::string, Entry>& all() const { return all_; }
  const Entry* find(const std::string& name) const;
  bool has_section(const std::string& name) const { return section_places_.contains(name); }
  /// The best place to point at for `name`: the value, else its section, else the source.
  Place place_of(const std::string& name) const;

 private:
  void collect(const toml::table& table, const std::string& prefix, const std::string& source);

  std::string source_;
  std::deque<toml::table> tables_;  // own the values of the entries
  std::map<std::string, Entry> all_;
  std::map<std::string, Place> section_places_;
};

/// Place of a node or key of a table read from `source`.
Place place_in(const std::string& source, const toml::source_region& region);

}  // namespace spume::config
