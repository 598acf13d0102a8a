#pragma once

#include <filesystem>
#include <string>

#include "apps/spume/load_case.hpp"
#include "spume/parallel/communicator.hpp"
#include "spume/simulation/run.hpp"

namespace spume::app {

/// Whether a live line can be shown: standard error is a terminal and the user wants to see it.
bool wants_progress(bool quiet);

/// Writes lines to the log, one by one.
void log_lines(const std::string& text);

/// Says what will be run and how large it is, on the terminal and in the log. Rank 0.
void announce(const LoadedCase& loaded, const std::filesystem::path& file,
              const std::filesystem::path& folder, int n_ranks, bool quiet);

/// Says how the run ended and where its files are, on the terminal and in the log. Collective.
/// Throws Interrupted when the user stopped it.
void conclude(const parallel::Communicator& communicator, const simulation::RunSummary& summary,
              const std::filesystem::path& folder, bool quiet);

/// What to add to the message of a numerical failure: where the last good state is.
std::string after_failure(const std::filesystem::path& folder);

}  // namespace spume::app
