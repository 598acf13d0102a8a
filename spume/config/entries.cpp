#include "spume/config/entries.hpp"

#include <algorithm>
#include <memory>

#include "spume/base/error.hpp"
#include "spume/config/key.hpp"
#include "spume/config/keys.hpp"

namespace spume::config {

namespace {

bool is_section(const std::string& name) {
  return std::ranges::any_of(sections(), [&](const Section& s) { return s.name == name; });
}

bool is_bare_word(const std::string& text) {
  const auto is_of_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         std::ranges::all_of(text, is_of_word);
}

/// The table of "section.key=value", text without its quotes allowed for the value.
toml::table parse_option(const std::string& option, const std::string& source) {
  const auto equals = option.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(source + ": an option has the form section.key=value");
  const std::string value = option.substr(equals + 1);
  if (value.empty()) throw InputError(source + ": no value after '='");
  try {
    return toml::parse(option, source);
  } catch (const toml::parse_error& error) {
    if (!is_bare_word(value)) throw InputError(source + ": " + std::string(error.description()));
  }
  try {  // a word without quotes is meant as text
    return toml::parse(option.substr(0, equals) + "=\"" + value + "\"", source);
  } catch (const toml::parse_error& error) {
    throw InputError(source + ": " + std::string(error.description()));
  }
}

}  // namespace

Place place_in(const std::string& source, const toml::source_region& region) {
  return {source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Entries::Entries(const std::string& text, const std::string& source) : source_(source) {
  try {
    tables_.push_back(toml::parse(text, source));
  } catch (const toml::parse_error& error) {
    throw InputError(place_in(source, error.source()).text() + ": " + std::string(error.description()));
  }
  collect(tables_.back(), "", source);
}

void Entries::set(const std::string& option) {
  const std::string source = "--set " + option;
  tables_.push_back(parse_option(option, source));
  collect(tables_.back(), "", source);
}

void Entries::collect(const toml::table& table, const std::string& prefix, const std::string& source) {
  // An option has one line, which the reader sees whole: its name is place enough.
  const bool from_file = source == source_;
  const auto place = [&](const toml::source_region& region) {
    return from_file ? place_in(source, region) : Place{source};
  };
  for (const auto& [key, value] : table) {
    const std::string name = prefix.empty() ? std::string(key.str()) : prefix + "." + std::string(key.str());
    if (value.is_table() && is_section(name)) {
      if (from_file)
        section_places_.insert_or_assign(name, place(key.source()));
      else
        section_places_.emplace(name, place(key.source()));
      collect(*value.as_table(), name, source);
    } else {
      all_.insert_or_assign(name, Entry{&value, place(value.source()), place(key.source())});
    }
  }
}

const Entry* Entries::find(const std::string& name) const {
  const auto found = all_.find(name);
  return found == all_.end() ? nullptr : &found->second;
}

Place Entries::place_of(const std::string& name) const {
  if (const Entry* entry = find(name)) return entry->place;
  const auto section = section_places_.find(section_of(name));
  return section != section_places_.end() ? section->second : Place{source_};
}

}  // namespace spume::config
