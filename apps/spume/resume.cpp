#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fstream>
#include <memory>

#include "apps/spume/commands.hpp"
#include "apps/spume/load_case.hpp"
#include "apps/spume/log_file.hpp"
#include "apps/spume/output_folder.hpp"
#include "apps/spume/run_report.hpp"
#include "apps/spume/stop_signal.hpp"
#include "spume/base/error.hpp"
#include "spume/config/write_case.hpp"
#include "spume/io/checkpoint.hpp"

namespace spume::app {

namespace {

namespace fs = std::filesystem;

struct Request {
  std::string folder;
  std::vector<std::string> options;
  bool quiet = false;
};

void check_run_folder(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder.string() + ": no such folder");
  if (!holds_run(folder))
    throw InputError(folder.string() + ": holds no run (no " + resolved_case_name + ")");
  if (!io::has_checkpoint(folder))
    throw InputError(folder.string() + ": holds no complete checkpoint to go on from");
}

/// The films and the gas of a checkpoint live in one box; overrides must not change it.
void check_same_box(const grid::Box& before, const grid::Box& now, const fs::path& folder) {
  const bool same = before.lower == now.lower && before.upper == now.upper && before.cells == now.cells &&
                    before.boundary == now.boundary;
  if (!same) throw InputError(folder.string() + ": [domain] cannot change when a run is resumed");
}

/// Replaces the resolved case by the one with the overrides, so that the folder says what was run.
void store_case(const fs::path& folder, const simulation::Case& run_case) {
  const fs::path file = folder / resolved_case_name, beside = folder / "case.toml.new";
  std::ofstream stream(beside);
  stream << config::write_case(run_case) << std::flush;
  if (!stream) throw InputError(beside.string() + ": cannot be written");
  stream.close();
  fs::rename(beside, file);
}

void resume(const parallel::Communicator& communicator, const Request& request) {
  const fs::path folder = request.folder;
  communicator.on_root([&] { check_run_folder(folder); });
  const fs::path file = folder / resolved_case_name;
  const LoadedCase before = load_case(communicator, file, {});
  const LoadedCase loaded = load_case(communicator, file, request.options);
  communicator.together([&] { check_same_box(before.run_case.box, loaded.run_case.box, folder); });

  const LogFile log(communicator, folder, LogFile::Mode::Append);
  communicator.on_root([&] {
    announce(loaded, file, folder, communicator.size(), request.quiet);
    for (const auto& option : request.options) log_lines("resumed with --set " + option);
    if (!request.options.empty()) store_case(folder, loaded.run_case);
  });
  stop_on_signal();
  try {
    const auto summary = simulation::resume(communicator, loaded.run_case, folder,
                                            {.force = false, .progress = wants_progress(request.quiet)});
    conclude(communicator, summary, folder, request.quiet);
  } catch (const NumericalError& error) {
    const std::string message = error.what() + after_failure(folder);
    log_lines("failed: " + message);
    throw NumericalError(message);
  }
}

}  // namespace

void add_resume(CLI::App& program, const parallel::Communicator& communicator) {
  const auto request = std::make_shared<Request>();
  CLI::App* command = program.add_subcommand("resume", "go on from the last complete checkpoint of a run");
  command->add_option("DIR", request->folder, "output folder of the run")->required();
  command->add_option("--set", request->options, "section.key=value, in place of what the run had")
      ->allow_extra_args(false);
  command->add_flag("--quiet", request->quiet, "say nothing unless something fails");
  command->callback([request, communicator] { resume(communicator, *request); });
}

}  // namespace spume::app
