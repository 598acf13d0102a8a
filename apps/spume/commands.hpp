#pragma once

#include <CLI/App.hpp>
#include <stdexcept>

#include "spume/parallel/communicator.hpp"

namespace spume::app {

/// What was computed is not what it should be; exit code 1.
struct FailedCheck : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Each function adds one sub-command to the command line; its work is done when the line has been parsed. A
// sub-command throws InputError, NumericalError or Interrupted, which the program turns into its exit code.
// Only rank 0 writes.
void add_run(CLI::App& program, const parallel::Communicator& communicator);
void add_resume(CLI::App& program, const parallel::Communicator& communicator);
void add_check(CLI::App& program, const parallel::Communicator& communicator);
void add_describe(CLI::App& program, const parallel::Communicator& communicator);
void add_info(CLI::App& program, const parallel::Communicator& communicator);
void add_render(CLI::App& program, const parallel::Communicator& communicator);
void add_verify(CLI::App& program, const parallel::Communicator& communicator);

}  // namespace spume::app
