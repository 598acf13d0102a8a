#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace spume::io {

/// One HDF5 file of numeric arrays, on one rank. Groups in a name ("films/position") come into being as
/// needed. Numbers keep their bits. Every function throws std::runtime_error, with the path and the name,
/// when it fails.
class Hdf5File {
 public:
  static Hdf5File create(const std::filesystem::path& path);
  static Hdf5File open(const std::filesystem::path& path);
  ~Hdf5File();
  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File(const Hdf5File&) = delete;

  /// `shape`: lengths of the dimensions, the last one fastest; their product is the number of values.
  void write(const std::string& name, std::span<const double> values,
             const std::vector<std::size_t>& shape) const;
  void write(const std::string& name, std::span<const int> values,
             const std::vector<std::size_t>& shape) const;
  std::vector<double> read(const std::string& name) const;
  std::vector<int> read_int(const std::string& name) const;
  /// Names inside a group, in alphabetic order.
  std::vector<std::string> names(const std::string& group) const;
  void create_group(const std::string& name) const;

  /// Closes the file and says whether all went well; nothing else may be called afterwards.
  void close();

 private:
  using Id = std::int64_t;
  Hdf5File(std::filesystem::path path, Id id) : path_(std::move(path)), id_(id) {}
  Id checked(Id result, const std::string& what) const;
  void write(const std::string& name, const void* values, std::size_t n,
             const std::vector<std::size_t>& shape, Id type) const;
  template <class Value>
  std::vector<Value> read_as(const std::string& name, Id type) const;

  std::filesystem::path path_;
  Id id_;
};

}  // namespace spume::io
