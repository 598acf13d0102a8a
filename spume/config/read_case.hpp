#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spume/simulation/case.hpp"

namespace spume::config {

/// The text of a file. Throws InputError when it cannot be read.
std::string read_text(const std::filesystem::path& file);

/// The case that a TOML text asks for; keys that are not written have their defaults. `source` names the text
/// in messages
/// ("cases/fig15/case.toml"); `options` are overrides "section.key=value" in TOML, as from `--set`, the last
/// one wins. Throws one InputError that tells all problems, one a line, each with its place: unknown keys and
/// sections with the nearest valid ones, wrong types, values out of range, keys that this version does not
/// have, missing keys, and what contradicts itself (cells that are no cubes, bubbles outside the box, …).
simulation::Case parse_case(const std::string& text, const std::string& source,
                            const std::vector<std::string>& options = {});

}  // namespace spume::config
