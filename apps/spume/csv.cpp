#include "apps/spume/csv.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "spume/base/error.hpp"
#include "spume/config/read_case.hpp"

namespace spume::app {

namespace {

/// The values of a line; in quotes a comma is text and two quotes are one.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> values(1);
  bool in_quotes = false;
  for (std::size_t c = 0; c < line.size(); ++c) {
    if (line[c] == '"') {
      if (in_quotes && c + 1 < line.size() && line[c + 1] == '"')
        values.back() += line[c++];
      else
        in_quotes = !in_quotes;
    } else if (line[c] == ',' && !in_quotes) {
      values.emplace_back();
    } else {
      values.back() += line[c];
    }
  }
  return values;
}

}  // namespace

Csv::Csv(const std::filesystem::path& file) : file_(file) {
  std::istringstream lines(config::read_text(file));
  std::string line;
  if (std::getline(lines, line)) header_ = split(line);
  while (std::getline(lines, line) && !lines.eof()) {
    rows_.push_back(split(line));
    if (rows_.back().size() != header_.size())
      throw InputError(file.string() + ": row " + std::to_string(rows_.size()) + " does not fit its header");
  }
}

const std::string& Csv::text(std::size_t row, const std::string& column) const {
  const auto found = std::ranges::find(header_, column);
  if (found == header_.end()) throw InputError(file_.string() + ": has no column " + column);
  return rows_.at(row)[found - header_.begin()];
}

double Csv::number(std::size_t row, const std::string& column) const {
  const std::string& value = text(row, column);
  double number = 0;
  const auto result = std::from_chars(value.data(), value.data() + value.size(), number);
  if (result.ec != std::errc{} || result.ptr != value.data() + value.size())
    throw InputError(file_.string() + ": column " + column + " holds no number: " + value);
  return number;
}

}  // namespace spume::app
