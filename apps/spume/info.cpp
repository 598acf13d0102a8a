#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "apps/spume/commands.hpp"
#include "apps/spume/csv.hpp"
#include "apps/spume/output_folder.hpp"
#include "spume/base/error.hpp"
#include "spume/config/text.hpp"

namespace spume::app {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string counts_text(const std::map<std::string, int>& counts) {
  std::vector<std::string> words;
  for (const auto& [name, count] : counts) words.push_back(fmt::format("{} {}", count, name));
  return config::joined(words);
}

/// Every event, or the first and last ones of a long story.
std::string events_text(const Csv& events) {
  constexpr std::size_t most = 60;
  std::map<std::string, int> counts;
  Rows rows;
  for (std::size_t e = 0; e < events.n_rows(); ++e) {
    ++counts[events.text(e, "event")];
    const bool shown = events.n_rows() <= most || e < most / 2 || e >= events.n_rows() - most / 2;
    if (shown)
      rows.push_back({fmt::format("{:.6g} s", events.number(e, "time_s")), events.text(e, "event"),
                      events.text(e, "detail")});
    else if (e == most / 2)
      rows.push_back({"…", fmt::format("{} more in events.csv", events.n_rows() - most), ""});
  }
  if (counts.empty()) return "no events\n";
  return "events: " + counts_text(counts) + "\n" + config::aligned(rows);
}

double largest_size(const Csv& history, const std::string& column) {
  double largest = 0;
  for (std::size_t row = 0; row < history.n_rows(); ++row)
    largest = std::max(largest, std::abs(history.number(row, column)));
  return largest;
}

std::string history_text(const Csv& history) {
  if (history.n_rows() == 0) return "no steps\n";
  const std::size_t last = history.n_rows() - 1;
  std::map<std::string, int> steps;
  for (std::size_t row = 0; row <= last; ++row) ++steps[history.text(row, "stage")];
  const auto change = [&](const std::string& column) {
    return history.text(0, column) + " → " + history.text(last, column);
  };
  const auto liquid = [&](std::size_t row) {
    return history.number(row, "lamella_liquid_m3") + history.number(row, "border_liquid_m3");
  };
  const Rows rows{{"time", fmt::format("{:.6g} s", history.number(last, "time_s"))},
                  {"steps", counts_text(steps)},
                  {"bubbles", change("bubbles")},
                  {"lamellae", change("lamellae")},
                  {"borders", change("borders")},
                  {"junctions", change("junctions")},
                  {"film area", fmt::format("{:.4g} → {:.4g} m²", history.number(0, "film_area_m2"),
                                            history.number(last, "film_area_m2"))},
                  {"thinnest film", fmt::format("{:.3g} → {:.3g} m (half-thickness)",
                                                history.number(0, "min_half_thickness_m"),
                                                history.number(last, "min_half_thickness_m"))},
                  {"liquid", fmt::format("{:.4g} → {:.4g} m³ in films and borders", liquid(0), liquid(last))},
                  {"ledger", fmt::format("off by {:.1e} at the end, {:.1e} at most",
                                         history.number(last, "liquid_error_rel"),
                                         largest_size(history, "liquid_error_rel"))},
                  {"volumes", fmt::format("bubbles off their targets by {:.1e} at most",
                                          largest_size(history, "max_volume_error_rel"))},
                  {"fastest gas", fmt::format("{:.3g} m/s", largest_size(history, "max_speed_m_s"))}};
  return config::aligned(rows);
}

void info(const std::filesystem::path& folder) {
  if (!holds_run(folder))
    throw InputError(folder.string() + ": holds no run (no " + resolved_case_name + ")");
  const std::string text =
      history_text(Csv(folder / "history.csv")) + events_text(Csv(folder / "events.csv"));
  std::printf("%s\n%s", folder.c_str(), text.c_str());
}

}  // namespace

void add_info(CLI::App& program, const parallel::Communicator& communicator) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command =
      program.add_subcommand("info", "what happened in a run: events, liquid ledger, final counts");
  command->add_option("DIR", *folder, "output folder of the run")->required();
  command->callback([folder, communicator] { communicator.on_root([&] { info(*folder); }); });
}

}  // namespace spume::app
