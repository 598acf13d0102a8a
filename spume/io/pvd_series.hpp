#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spume::io {

/// A ParaView collection: the frames of a series of VTK files and their times. The file is replaced whole at
/// each new frame, so that it is valid at any instant. For one rank.
class PvdSeries {
 public:
  struct Frame {
    double time;       ///< [s]
    std::string file;  ///< relative to the folder of the .pvd
  };

  /// Starts an empty series.
  explicit PvdSeries(std::filesystem::path path);
  /// Goes on with a series of which only the first `n_frames` count. Throws InputError when there are fewer.
  PvdSeries(std::filesystem::path path, int n_frames);

  /// Throws std::runtime_error when the disk refuses.
  void append(double time, const std::string& file);
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  void write() const;

  std::filesystem::path path_;
  std::vector<Frame> frames_;
};

/// The frames of a .pvd as this program writes it. Throws InputError when it cannot be read.
std::vector<PvdSeries::Frame> read_pvd(const std::filesystem::path& path);

}  // namespace spume::io
