#include "spume/io/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "spume/base/contract.hpp"

namespace spume::io {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

namespace {

/// Closes an HDF5 object on every way out.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t get() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// HDF5 would print its own trace for each failure; ours become exceptions.
void be_quiet() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

Hdf5File::Id Hdf5File::checked(Id result, const std::string& what) const {
  if (result < 0) throw std::runtime_error(fmt::format("{}: HDF5 cannot {}", path_.string(), what));
  return result;
}

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
  be_quiet();
  Hdf5File file(path, H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  file.checked(file.id_, "create the file");
  return file;
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  be_quiet();
  Hdf5File file(path, H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  file.checked(file.id_, "open the file");
  return file;
}

Hdf5File::~Hdf5File() {
  if (id_ >= 0) H5Fclose(id_);
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)) {}

void Hdf5File::close() {
  checked(H5Fflush(id_, H5F_SCOPE_GLOBAL), "flush the file");
  checked(H5Fclose(std::exchange(id_, -1)), "close the file");
}

void Hdf5File::create_group(const std::string& name) const {
  const Handle group(H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  checked(group.get(), "create " + name);
}

void Hdf5File::write(const std::string& name, const void* values, std::size_t n,
                     const std::vector<std::size_t>& shape, Id type) const {
  expects(std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()) == n,
          "the shape of an array has as many entries as the array");
  const std::vector<hsize_t> lengths(shape.begin(), shape.end());
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  checked(H5Pset_create_intermediate_group(links.get(), 1), "create " + name);
  const Handle space(H5Screate_simple(static_cast<int>(lengths.size()), lengths.data(), nullptr), H5Sclose);
  checked(space.get(), "create " + name);
  const Handle set(H5Dcreate2(id_, name.c_str(), type, space.get(), links.get(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  checked(set.get(), "create " + name);
  checked(H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write " + name);
}

void Hdf5File::write(const std::string& name, std::span<const double> values,
                     const std::vector<std::size_t>& shape) const {
  write(name, values.data(), values.size(), shape, H5T_NATIVE_DOUBLE);
}

void Hdf5File::write(const std::string& name, std::span<const int> values,
                     const std::vector<std::size_t>& shape) const {
  write(name, values.data(), values.size(), shape, H5T_NATIVE_INT);
}

template <class Value>
std::vector<Value> Hdf5File::read_as(const std::string& name, Id type) const {
  const Handle set(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  checked(set.get(), "find " + name);
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  std::vector<Value> values(
      static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space.get()), "measure " + name)));
  checked(H5Dread(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read " + name);
  return values;
}

std::vector<double> Hdf5File::read(const std::string& name) const {
  return read_as<double>(name, H5T_NATIVE_DOUBLE);
}

std::vector<int> Hdf5File::read_int(const std::string& name) const {
  return read_as<int>(name, H5T_NATIVE_INT);
}

std::vector<std::string> Hdf5File::names(const std::string& group) const {
  std::vector<std::string> found;
  checked(H5Literate_by_name(id_, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &found,
                             H5P_DEFAULT),
          "list " + group);
  return found;
}

}  // namespace spume::io
