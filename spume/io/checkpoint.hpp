#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "spume/state/foam.hpp"

namespace spume::io {

/// What a checkpoint holds beside the foam: named numbers, lists and points of the simulation (stage,
/// counters, …). A name is not empty and has no '/'.
struct CheckpointExtras {
  std::map<std::string, double> numbers;
  std::map<std::string, std::vector<double>> lists;
};

/// Writes the complete state to folder/checkpoint (HDF5): first beside it, then renamed, so that a kill at
/// any instant leaves one complete checkpoint. Collective; rank 0 writes. Throws std::runtime_error when the
/// disk refuses.
void save_checkpoint(const std::filesystem::path& folder, const state::Foam& foam,
                     const CheckpointExtras& extras);

/// Reads the last complete checkpoint bit for bit. Collective; the number of ranks may differ from that of
/// the run that wrote it. Throws InputError where there is none or it does not fit the grid of `foam`.
CheckpointExtras load_checkpoint(const std::filesystem::path& folder, state::Foam& foam);

/// Whether the folder holds a complete checkpoint. Looks at the files from the calling rank.
bool has_checkpoint(const std::filesystem::path& folder);

}  // namespace spume::io
