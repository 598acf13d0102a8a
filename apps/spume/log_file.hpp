#pragma once

#include <filesystem>

#include "spume/parallel/communicator.hpp"

namespace spume::app {

/// The log of a run: for its life spdlog's default logger writes to log.txt in the output folder, on rank 0
/// alone. What is said before the folder holds a run is kept and written then, so that a run that is refused
/// leaves nothing.
class LogFile {
 public:
  enum class Mode { New, Append };
  LogFile(const parallel::Communicator& communicator, const std::filesystem::path& folder, Mode mode);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;
};

}  // namespace spume::app
