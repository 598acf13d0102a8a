#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spume/parallel/communicator.hpp"
#include "spume/simulation/case.hpp"

namespace spume::app {

/// A case that can be run: read, checked, its bubbles placed.
struct LoadedCase {
  simulation::Case run_case;
  std::vector<simulation::BubbleShape> bubbles;
};

/// Reads a case file with `--set` overrides; rank 0 reads, all ranks get the same case. Collective. Throws
/// InputError with all that is wrong.
LoadedCase load_case(const parallel::Communicator& communicator, const std::filesystem::path& file,
                     const std::vector<std::string>& options);

}  // namespace spume::app
