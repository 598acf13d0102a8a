#pragma once

#include <filesystem>
#include <functional>
#include <optional>

namespace spume::io {

/// The folders of a checkpoint and the order in which they are written, renamed and removed. A checkpoint is
/// a folder with a marker file, written last and removed first; at every instant after the first checkpoint
/// one of checkpoint/, checkpoint.new/, checkpoint.old/ has the marker and is whole. For one rank.
class CheckpointFolders {
 public:
  explicit CheckpointFolders(const std::filesystem::path& folder);

  /// The newest complete checkpoint.
  std::optional<std::filesystem::path> complete() const;
  /// Calls `write` with the path of an empty folder, then makes that folder the checkpoint.
  /// Throws std::runtime_error when the disk refuses; the last good checkpoint is then still there.
  void replace(const std::function<void(const std::filesystem::path&)>& write) const;

 private:
  std::filesystem::path current_, new_, old_;
};

}  // namespace spume::io
