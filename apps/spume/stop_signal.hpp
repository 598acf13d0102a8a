#pragma once

namespace spume::app {

/// From now on the first SIGINT or SIGTERM asks the run to write a checkpoint and stop; a second one ends the
/// program.
void stop_on_signal();

}  // namespace spume::app
