#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/spume/commands.hpp"
#include "spume/base/error.hpp"
#include "spume/config/nearest.hpp"
#include "spume/config/version.hpp"
#include "spume/parallel/session.hpp"

namespace spume::app {
namespace {

enum ExitCode { done = 0, wrong_input = 1, numerical_failure = 2, interrupted = 3 };

/// What is wrong with the command line. CLI11 takes an unknown sub-command for a missing one.
std::string complaint(const CLI::App& program, const CLI::ParseError& error) {
  const auto unknown = program.remaining();
  if (!program.get_subcommands().empty() || unknown.empty() || unknown.front().starts_with('-'))
    return error.what();
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return "unknown sub-command '" + unknown.front() + "'" +
         config::did_you_mean(config::nearest_names(unknown.front(), names));
}

/// Help and version are no failures, everything else that CLI11 throws is wrong input.
ExitCode answer(const CLI::App& program, const CLI::ParseError& error, bool is_root) {
  const bool asked_for = error.get_exit_code() == 0;
  if (is_root && asked_for) program.exit(error);
  if (is_root && !asked_for)
    std::fprintf(stderr, "%s\nspume --help and spume SUBCOMMAND --help show what is possible\n",
                 complaint(program, error).c_str());
  return asked_for ? done : wrong_input;
}

ExitCode run_program(int argc, char** argv, const parallel::Communicator& communicator) {
  CLI::App program("spume simulates how a foam lives and dies: rearrangement, drainage, rupture", "spume");
  program.set_version_flag("--version", config::version());
  program.require_subcommand(1);
  add_run(program, communicator);
  add_resume(program, communicator);
  add_check(program, communicator);
  add_describe(program, communicator);
  add_info(program, communicator);
  add_render(program, communicator);
  add_verify(program, communicator);

  const auto say = [&](const char* what, const std::exception& error) {
    if (communicator.is_root()) std::fprintf(stderr, "%s%s\n", what, error.what());
  };
  try {
    program.parse(argc, argv);
    return done;
  } catch (const CLI::ParseError& error) {
    return answer(program, error, communicator.is_root());
  } catch (const InputError& error) {
    say("", error);
    return wrong_input;
  } catch (const FailedCheck& error) {
    say("", error);
    return wrong_input;
  } catch (const Interrupted& error) {
    say("", error);
    return interrupted;
  } catch (const NumericalError& error) {
    say("failed: ", error);
    return numerical_failure;
  } catch (const std::exception& error) {  // no agreed failure of all ranks: this one may be alone
    std::fprintf(stderr, "failed: %s\n", error.what());
    if (communicator.size() > 1) communicator.abort(numerical_failure);
    return numerical_failure;
  }
}

}  // namespace
}  // namespace spume::app

int main(int argc, char** argv) {
  try {
    const spume::parallel::Session session(argc, argv);
    return spume::app::run_program(argc, argv, spume::parallel::Communicator::world());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "failed: %s\n", error.what());
    return spume::app::numerical_failure;
  }
}
