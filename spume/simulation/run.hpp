#pragma once

#include <filesystem>

#include "spume/parallel/communicator.hpp"
#include "spume/simulation/case.hpp"

namespace spume::simulation {

struct RunOptions {
  bool force = false;    ///< overwrite an earlier run
  bool progress = true;  ///< live line (only ever on a terminal)
};

/// How a run ended, for the summary.
struct RunSummary {
  double time;  ///< simulated [s]
  int ruptures, bubbles, lamellae, borders, junctions;
  double film_area;     ///< [m²]
  double liquid_error;  ///< of the ledger, relative
  double wall_seconds;
  bool interrupted;  ///< SIGINT: a checkpoint was written
};

/// Runs a case into a new output folder. `resolved_case` is the text of the case file with every default, to
/// be stored. Collective. Throws InputError when the folder holds a run and `force` is not set, or other
/// files; Interrupted, and leaves the folder as it was, when the user stops it before the foam of time 0 is
/// there.
RunSummary run(const parallel::Communicator& communicator, const Case& run_case,
               const std::string& resolved_case, const std::filesystem::path& folder,
               const RunOptions& options);

/// Goes on from the last complete checkpoint in `folder`. Collective. Throws InputError where there is none.
RunSummary resume(const parallel::Communicator& communicator, const Case& run_case,
                  const std::filesystem::path& folder, const RunOptions& options);

/// Asks a running simulation to write a checkpoint and stop; safe to call from a signal handler.
void request_stop();

}  // namespace spume::simulation
