#pragma once

#include <filesystem>

#include "spume/simulation/diary.hpp"
#include "spume/simulation/run_state.hpp"

namespace spume::simulation {

/// A checkpoint of a run: the foam, the counters, and how far the diary had got. Collective.
void save(const std::filesystem::path& folder, const RunState& run, const DiaryMark& mark);
/// The counterpart. Throws InputError where there is no complete checkpoint.
DiaryMark load(const std::filesystem::path& folder, RunState& run);

}  // namespace spume::simulation
