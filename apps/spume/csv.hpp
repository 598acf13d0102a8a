#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spume::app {

/// A table of comma-separated values with a header line, as io::CsvTable writes it.
class Csv {
 public:
  /// A last row that was cut short is left out. Throws InputError when the file cannot be read.
  explicit Csv(const std::filesystem::path& file);

  std::size_t n_rows() const { return rows_.size(); }
  /// Throws InputError when there is no such column, or it holds no number.
  const std::string& text(std::size_t row, const std::string& column) const;
  double number(std::size_t row, const std::string& column) const;

 private:
  std::filesystem::path file_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace spume::app
