#include "spume/io/checkpoint_folders.hpp"

#include <fstream>
#include <stdexcept>

#include "spume/io/durable.hpp"

namespace spume::io {

namespace {

constexpr const char* marker = "complete";

bool is_complete(const std::filesystem::path& checkpoint) {
  return std::filesystem::exists(checkpoint / marker);
}

void discard(const std::filesystem::path& checkpoint) {
  if (std::filesystem::remove(checkpoint / marker)) put_on_disk(checkpoint);
  std::filesystem::remove_all(checkpoint);
}

void mark_complete(const std::filesystem::path& checkpoint) {
  for (const auto& entry : std::filesystem::directory_iterator(checkpoint)) put_on_disk(entry.path());
  write_text_durably(checkpoint / marker, "This checkpoint is complete.\n");
}

}  // namespace

CheckpointFolders::CheckpointFolders(const std::filesystem::path& folder)
    : current_(folder / "checkpoint"), new_(folder / "checkpoint.new"), old_(folder / "checkpoint.old") {}

std::optional<std::filesystem::path> CheckpointFolders::complete() const {
  for (const auto& candidate : {new_, current_, old_})
    if (is_complete(candidate)) return candidate;
  return std::nullopt;
}

void CheckpointFolders::replace(const std::function<void(const std::filesystem::path&)>& write) const {
  const auto make_current = [&] {
    if (std::filesystem::exists(current_)) {
      discard(old_);
      replace_durably(current_, old_);
    }
    replace_durably(new_, current_);
    discard(old_);
  };
  if (is_complete(new_)) make_current();  // a kill came between the marker and the rename
  discard(new_);
  std::filesystem::create_directory(new_);
  write(new_);
  mark_complete(new_);
  make_current();
}

}  // namespace spume::io
