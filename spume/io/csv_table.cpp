#include "spume/io/csv_table.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"
#include "spume/io/durable.hpp"

namespace spume::io {

namespace {

std::string header_of(std::span<const Column> columns) {
  std::string header;
  for (const Column& column : columns) {
    if (!header.empty()) header += ',';
    header += column.name;
  }
  return header + '\n';
}

std::string quoted(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string result = "\"";
  for (char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string text_of(const CsvValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return quoted(*text);
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return fmt::format("{}", std::get<long>(value));
}

/// Bytes of the header and the first `rows` rows.
std::uintmax_t length_of(const std::filesystem::path& path, const std::string& header, long rows) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError(fmt::format("{}: cannot be read, but the checkpoint refers to it", path.string()));
  std::string line;
  std::getline(file, line);
  if (line + '\n' != header)
    throw InputError(
        fmt::format("{}: the first line is not '{}'", path.string(), header.substr(0, header.size() - 1)));
  std::uintmax_t length = header.size();
  for (long row = 0; row < rows; ++row) {
    // A last line without line end was cut short by a kill.
    if (!std::getline(file, line) || file.eof())
      throw InputError(
          fmt::format("{}: has {} rows, but the checkpoint refers to {}", path.string(), row, rows));
    length += line.size() + 1;
  }
  return length;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path, std::span<const Column> columns)
    : path_(path), n_columns_(columns.size()) {
  open("w");
  write(header_of(columns));
}

CsvTable::CsvTable(const std::filesystem::path& path, std::span<const Column> columns, long rows)
    : path_(path), n_columns_(columns.size()) {
  const auto length = length_of(path, header_of(columns), rows);
  std::error_code error;
  std::filesystem::resize_file(path, length, error);
  if (error) throw std::runtime_error(fmt::format("{}: cannot cut back: {}", path.string(), error.message()));
  open("a");
}

void CsvTable::open(const char* mode) {
  file_.reset(std::fopen(path_.c_str(), mode));
  if (!file_)
    throw std::runtime_error(fmt::format("{}: cannot write: {}", path_.string(), std::strerror(errno)));
}

void CsvTable::write(const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    throw std::runtime_error(fmt::format("{}: cannot write: {}", path_.string(), std::strerror(errno)));
}

void CsvTable::append(const std::vector<CsvValue>& row) {
  expects(row.size() == n_columns_, "a row has one value for each column");
  std::string line;
  for (const CsvValue& value : row) {
    if (!line.empty()) line += ',';
    line += text_of(value);
  }
  write(line + '\n');
}

void CsvTable::put_on_disk() {
  io::put_on_disk(path_);
}

}  // namespace spume::io
