#include "apps/spume/stop_signal.hpp"

#include <csignal>

#include "spume/simulation/run.hpp"

namespace spume::app {

namespace {

extern "C" void ask_to_stop(int signal) {
  std::signal(signal, SIG_DFL);
  simulation::request_stop();
}

}  // namespace

void stop_on_signal() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}

}  // namespace spume::app
