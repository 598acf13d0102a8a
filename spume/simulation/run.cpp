#include "spume/simulation/run.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <fstream>

#include "spume/base/error.hpp"
#include "spume/flow/surface_tension.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/simulation/cycle.hpp"
#include "spume/simulation/initial_foam.hpp"
#include "spume/simulation/run_checkpoint.hpp"

namespace spume::simulation {

namespace fs = std::filesystem;

namespace {

std::atomic<bool>& stop_flag() {
  static std::atomic<bool> wanted{false};
  return wanted;
}

constexpr const char* summary_file = "summary.txt";  // its presence tells that the run is finished

/// The folder for a new run. Removes on the way out what it made, unless told to keep it.
class NewFolder {
 public:
  NewFolder(const fs::path& folder, bool force) : folder_(folder) {
    std::error_code error;
    if (fs::exists(folder, error)) {
      if (!fs::is_directory(folder, error))
        throw InputError(fmt::format("{} is a file; give a folder for the output with -o", folder.string()));
      if (fs::exists(folder / "case.toml", error) && !force)
        throw InputError(
            fmt::format("{} holds {} run; go on with it by `spume resume {}`, give another folder with -o, "
                        "or overwrite it with --force",
                        folder.string(), fs::exists(folder / summary_file) ? "a finished" : "an unfinished",
                        folder.string()));
      if (!fs::exists(folder / "case.toml", error) && !fs::is_empty(folder, error))
        throw InputError(
            fmt::format("{} is not empty and holds no run; give another folder with -o", folder.string()));
    } else {
      made_ = fs::create_directories(folder, error);
      if (!made_)
        throw InputError(
            fmt::format("cannot make the output folder {}: {}", folder.string(), error.message()));
    }
    std::ofstream probe(folder / ".probe");
    if (!probe) throw InputError(fmt::format("cannot write into the output folder {}", folder.string()));
    probe.close();
    fs::remove(folder / ".probe", error);
  }
  ~NewFolder() {
    std::error_code error;
    if (made_ && !kept_) fs::remove_all(folder_, error);
  }
  void keep() { kept_ = true; }

 private:
  fs::path folder_;
  bool made_ = false, kept_ = false;
};

/// Takes away what an earlier run left in the folder; nothing else is touched.
void clear(const fs::path& folder) {
  for (const char* entry : {"case.toml", "history.csv", "bubbles.csv", "lamellae.csv", "borders.csv",
                            "events.csv", "films.pvd", "films", "gas.pvd", "gas", "checkpoint",
                            "checkpoint.new", "checkpoint.old", "README.txt", summary_file})
    fs::remove_all(folder / entry);
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out) throw InputError(fmt::format("cannot write {}", file.string()));
}

RunSummary summarize(const RunState& run, double initial_liquid, double wall_seconds) {
  const auto topology = mesh::build_topology(run.foam.films);
  const double liquid = run.foam.liquid.total() + run.foam.liquid.sprayed;
  return {.time = run.foam.time,
          .ruptures = run.ruptures,
          .bubbles = run.foam.phases.n_bubbles(),
          .lamellae = topology.n_lamellae(),
          .borders = topology.n_borders(),
          .junctions = topology.n_junctions(),
          .film_area = mesh::film_area(run.foam.films),
          .liquid_error = initial_liquid > 0 ? liquid / initial_liquid - 1 : 0,
          .wall_seconds = wall_seconds,
          .interrupted = false};
}

std::string text_of(const RunSummary& summary) {
  return fmt::format(
      "simulated time   {:.6g} s\nruptures         {}\nbubbles          {}\nlamellae         {}\nPlateau "
      "borders  {}\n"
      "junctions        {}\nfilm area        {:.6g} m2\nliquid ledger    off by {:.2g} relative\n",
      summary.time, summary.ruptures, summary.bubbles, summary.lamellae, summary.borders, summary.junctions,
      summary.film_area, summary.liquid_error);
}

/// The foam of time 0. Throws Interrupted when the user stops its relaxation.
void start_foam(const parallel::Communicator& communicator, const Case& run_case, const RunOptions& options,
                RunState& run, std::vector<state::Event>& events) {
  ProgressLine progress(options.progress && communicator.is_root());
  int n_steps = 0;
  make_initial_foam(run_case, run.foam, events, [&](const auto&, const auto&) {
    progress.show({.stage = "equilibrate",
                   .limited_by = fmt::format("step {} of a relaxation without gas", ++n_steps),
                   .bubbles = run.foam.phases.n_bubbles()});
    if (communicator.any(stop_flag().load()))
      throw Interrupted("stopped while the foam of time 0 came to equilibrium; nothing was saved");
    return true;
  });
  run.bubbles_at_start = run.foam.phases.n_bubbles();
}

RunSummary go_on(const parallel::Communicator& communicator, const Case& run_case, const fs::path& folder,
                 const RunOptions& options, RunState& run, Diary& diary) {
  const auto started = std::chrono::steady_clock::now();
  ProgressLine progress(options.progress && communicator.is_root());
  Witness witness(
      communicator, run_case, diary, progress, [&](const RunState& now) { save(folder, now, diary.mark()); },
      [] { return stop_flag().load(); });
  bool interrupted = false;
  try {
    cycle(run.foam.gas.pressure.grid(), run_case, run, witness);
    run.finished = true;
    witness.checkpoint(run);
  } catch (const Interrupted&) {
    interrupted = true;
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
  RunSummary summary = summarize(run, diary.mark().initial_liquid, wall.count());
  summary.interrupted = interrupted;
  if (!interrupted) communicator.on_root([&] { write_text(folder / summary_file, text_of(summary)); });
  return summary;
}

}  // namespace

RunSummary run(const parallel::Communicator& communicator, const Case& run_case,
               const std::string& resolved_case, const fs::path& folder, const RunOptions& options) {
  std::unique_ptr<NewFolder> new_folder;
  communicator.on_root([&] { new_folder = std::make_unique<NewFolder>(folder, options.force); });
  const grid::Grid grid(communicator, run_case.box);
  RunState run(grid);
  std::vector<state::Event> events;
  start_foam(communicator, run_case, options, run, events);

  communicator.on_root([&] {
    clear(folder);
    new_folder->keep();
    write_text(folder / "case.toml", resolved_case);
  });
  Diary diary(communicator, folder, run_case, {}, false);
  for (const auto& event : events) diary.record_event(event);
  const auto topology = mesh::build_topology(run.foam.films);
  StepRecord start{.step = run.step++, .stage = run.stage};
  diary.record_step(run.foam, topology, start);
  const auto forces = flow::film_forces(run.foam.films, topology, run.foam.phases.count(),
                                        run_case.materials.film.surface_tension);
  diary.record_frame(run.foam, topology, forces.pressure);
  run.has_frame = true;
  run.next_frame = run_case.output.rearrangement_interval;
  save(folder, run, diary.mark());
  return go_on(communicator, run_case, folder, options, run, diary);
}

RunSummary resume(const parallel::Communicator& communicator, const Case& run_case, const fs::path& folder,
                  const RunOptions& options) {
  const grid::Grid grid(communicator, run_case.box);
  RunState run(grid);
  const DiaryMark mark = load(folder, run);
  if (run.finished && is_over(run_case, run)) return summarize(run, mark.initial_liquid, 0);
  run.finished = false;  // it was given more to do: a later end time or more ruptures
  Diary diary(communicator, folder, run_case, mark, true);
  communicator.on_root([&] { fs::remove(folder / summary_file); });
  return go_on(communicator, run_case, folder, options, run, diary);
}

void request_stop() {
  stop_flag() = true;
}

}  // namespace spume::simulation
