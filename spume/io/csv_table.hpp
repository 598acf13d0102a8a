#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "spume/io/column.hpp"

namespace spume::io {

/// An entry of a table. Numbers are written with the fewest digits that read back to the same bits.
using CsvValue = std::variant<long, double, std::string>;

/// A growing table of comma-separated values with one header line. Each row reaches the system as soon as it
/// is appended, so that a kill of the program loses none. For one rank.
class CsvTable {
 public:
  /// Starts a new file with its header; one that exists is overwritten. Throws std::runtime_error when it
  /// cannot be written.
  CsvTable(const std::filesystem::path& path, std::span<const Column> columns);
  /// Goes on with a file of which only the first `rows` rows count; what follows them (also a row cut short
  /// by a kill) is cut off. Throws InputError when the file is missing, has another header or fewer rows.
  CsvTable(const std::filesystem::path& path, std::span<const Column> columns, long rows);

  /// `row` has one value a column. Text with commas or quotes is quoted; line ends in it become spaces.
  /// Throws std::runtime_error when the disk refuses.
  void append(const std::vector<CsvValue>& row);
  /// All rows so far onto the disk.
  void put_on_disk();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void open(const char* mode);
  void write(const std::string& line);

  std::filesystem::path path_;
  std::size_t n_columns_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace spume::io
