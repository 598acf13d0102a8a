#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>

#include "apps/spume/commands.hpp"
#include "apps/spume/load_case.hpp"
#include "apps/spume/log_file.hpp"
#include "apps/spume/output_folder.hpp"
#include "apps/spume/run_report.hpp"
#include "apps/spume/stop_signal.hpp"
#include "spume/base/error.hpp"
#include "spume/config/write_case.hpp"

namespace spume::app {

namespace {

struct Request {
  std::string file, folder;
  std::vector<std::string> options;
  bool force = false, quiet = false;
};

void run(const parallel::Communicator& communicator, const Request& request) {
  const LoadedCase loaded = load_case(communicator, request.file, request.options);
  const std::filesystem::path folder =
      request.folder.empty() ? default_output_folder(request.file) : std::filesystem::path(request.folder);
  communicator.on_root([&] { check_output_folder(folder, request.file); });

  // A folder that holds a run is going to be refused unless --force is given: its log stays as it is.
  bool refused_here = false;
  communicator.on_root([&] { refused_here = !request.force && holds_run(folder); });
  const bool accepted = !communicator.any(refused_here);
  std::optional<LogFile> log;
  if (accepted) {
    log.emplace(communicator, folder, LogFile::Mode::New);
    communicator.on_root([&] { announce(loaded, request.file, folder, communicator.size(), request.quiet); });
  }
  stop_on_signal();
  try {
    const auto summary =
        simulation::run(communicator, loaded.run_case, config::write_case(loaded.run_case), folder,
                        {.force = request.force, .progress = wants_progress(request.quiet)});
    conclude(communicator, summary, folder, request.quiet);
  } catch (const NumericalError& error) {
    const std::string message = error.what() + after_failure(folder);
    if (log) log_lines("failed: " + message);
    throw NumericalError(message);
  }
}

}  // namespace

void add_run(CLI::App& program, const parallel::Communicator& communicator) {
  const auto request = std::make_shared<Request>();
  CLI::App* command = program.add_subcommand("run", "run a case into an output folder");
  command->add_option("CASE.toml", request->file, "the case file")->required();
  command->add_option("-o,--output", request->folder,
                      "output folder; by default named after the case file, with -run");
  command->add_option("--set", request->options, "section.key=value, in place of what the file says")
      ->allow_extra_args(false);
  command->add_flag("--force", request->force, "overwrite an earlier run");
  command->add_flag("--quiet", request->quiet, "say nothing unless something fails");
  command->callback([request, communicator] { run(communicator, *request); });
}

}  // namespace spume::app
