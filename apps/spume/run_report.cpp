#include "apps/spume/run_report.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <sstream>

#include "spume/base/error.hpp"
#include "spume/config/assess.hpp"
#include "spume/config/text.hpp"
#include "spume/config/version.hpp"
#include "spume/io/checkpoint.hpp"

namespace spume::app {

namespace {

void say(const std::string& text, bool quiet) {
  log_lines(text);
  if (quiet) return;
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

std::string ending(const simulation::RunSummary& summary) {
  const std::vector<std::vector<std::string>> rows{
      {"simulated time", fmt::format("{:.6g} s", summary.time)},
      {"ruptures", fmt::format("{}", summary.ruptures)},
      {"foam now", fmt::format("bubbles {}, lamellae {}, Plateau borders {}, junctions {}", summary.bubbles,
                               summary.lamellae, summary.borders, summary.junctions)},
      {"film area", fmt::format("{:.4g} m²", summary.film_area)},
      {"liquid ledger", fmt::format("off by {:.1e} of the liquid", summary.liquid_error)}};
  return fmt::format("{} after {:.1f} s of wall time\n", summary.interrupted ? "interrupted" : "done",
                     summary.wall_seconds) +
         config::aligned(rows);
}

std::string files_text(const std::filesystem::path& folder) {
  const std::string name = folder.string();
  const std::vector<std::vector<std::string>> rows{
      {"films.pvd", "the films over time, for ParaView"},
      {"events.csv", "what happened: ruptures, T1s, lost bubbles"},
      {"history.csv", "every step; bubbles.csv, lamellae.csv and borders.csv have the details"},
      {"README.txt", "what every file and column is"}};
  return "files in " + name + "\n" + config::aligned(rows);
}

}  // namespace

bool wants_progress(bool quiet) {
  return !quiet && ::isatty(STDERR_FILENO) == 1;
}

void log_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) spdlog::info("{}", line);
}

void announce(const LoadedCase& loaded, const std::filesystem::path& file,
              const std::filesystem::path& folder, int n_ranks, bool quiet) {
  const std::string& title = loaded.run_case.title;
  std::string text =
      fmt::format("spume {}, {} rank{}\n", config::version(), n_ranks, n_ranks == 1 ? "" : "s");
  text += fmt::format("case {}{}\n", file.string(), title.empty() ? "" : " (" + title + ")");
  text += config::report(config::assess(loaded.run_case, loaded.bubbles), loaded.run_case);
  text += fmt::format("output to {}\n", folder.string());
  say(text, quiet);
}

void conclude(const parallel::Communicator& communicator, const simulation::RunSummary& summary,
              const std::filesystem::path& folder, bool quiet) {
  const std::string resume = "go on with: spume resume " + folder.string();
  if (communicator.is_root()) {
    say(ending(summary) + files_text(folder), quiet);
    if (summary.interrupted) log_lines(resume);
  }
  if (summary.interrupted) throw Interrupted("interrupted; " + resume);
}

std::string after_failure(const std::filesystem::path& folder) {
  if (!io::has_checkpoint(folder)) return {};
  return "; the last good state is kept in " + folder.string() + ", spume resume goes on from there";
}

}  // namespace spume::app
