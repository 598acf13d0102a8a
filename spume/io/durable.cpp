#include "spume/io/durable.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace spume::io {

void put_on_disk(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  // Some network file systems cannot fsync a folder (EINVAL); they order renames by themselves.
  const bool failed = file < 0 || (::fsync(file) != 0 && errno != EINVAL);
  const int reason = errno;
  if (file >= 0) ::close(file);
  if (failed)
    throw std::runtime_error(
        fmt::format("{}: cannot put on the disk: {}", path.string(), std::strerror(reason)));
}

void replace_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  put_on_disk(from);
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error)
    throw std::runtime_error(
        fmt::format("{}: cannot rename to {}: {}", from.string(), to.string(), error.message()));
  put_on_disk(to.parent_path().empty() ? std::filesystem::path(".") : to.parent_path());
}

void write_text_durably(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path beside = path.string() + ".new";
  {
    std::ofstream file(beside, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(fmt::format("{}: cannot write", beside.string()));
  }
  replace_durably(beside, path);
}

}  // namespace spume::io
