#pragma once

#include <string>
#include <vector>

namespace spume::config {

/// "a, b, c".
std::string joined(const std::vector<std::string>& words, const std::string& between = ", ");

/// The text with quotes, as TOML.
std::string quoted(const std::string& text);

/// Rows in columns of equal width, two blanks before each; rows have the same number of cells.
std::string aligned(const std::vector<std::vector<std::string>>& rows);

}  // namespace spume::config
