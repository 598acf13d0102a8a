#include "spume/simulation/witness.hpp"

#include <algorithm>
#include <chrono>

#include "spume/flow/surface_tension.hpp"

namespace spume::simulation {

namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The share of the run that is done, by whichever goal is nearest: end time, ruptures, or the last bubble.
double fraction_done(const Case& run_case, const RunState& run) {
  const double by_time = run.foam.time / run_case.cycle.end_time;
  const double by_ruptures = static_cast<double>(run.ruptures) / run_case.cycle.max_ruptures;
  const double by_bubbles = run.bubbles_at_start > 1
                                ? static_cast<double>(run.bubbles_at_start - run.foam.phases.n_bubbles()) /
                                      (run.bubbles_at_start - 1)
                                : 0.0;
  return std::clamp(std::max({by_time, by_ruptures, by_bubbles}), 0.0, 1.0);
}

}  // namespace

Witness::Witness(const parallel::Communicator& communicator, const Case& run_case, Diary& diary,
                 ProgressLine& progress, std::function<void(const RunState&)> save,
                 std::function<bool()> stop_wanted)
    : communicator_(communicator),
      case_(run_case),
      diary_(diary),
      progress_(progress),
      save_(std::move(save)),
      stop_wanted_(std::move(stop_wanted)),
      last_checkpoint_(wall_seconds()) {}

void Witness::step(RunState& run, const mesh::Topology& topology, StepRecord record,
                   const std::string& limited_by) {
  record.step = run.step++;
  record.stage = run.stage;
  record.limited_by = limited_by;
  run.has_frame = false;
  diary_.record_step(run.foam, topology, record);
  show(run, record.dt, limited_by);
}

void Witness::frame(RunState& run, const mesh::Topology& topology, double interval) {
  if (run.has_frame) return;
  const auto forces = flow::film_forces(run.foam.films, topology, run.foam.phases.count(),
                                        case_.materials.film.surface_tension);
  diary_.record_frame(run.foam, topology, forces.pressure);
  run.has_frame = true;
  run.next_frame = run.foam.time + interval;
}

void Witness::frame_if_due(RunState& run, const mesh::Topology& topology, double interval) {
  if (run.foam.time >= run.next_frame) frame(run, topology, interval);
}

void Witness::event(const RunState& run, const std::string& kind, const std::string& detail) {
  events({{run.foam.time, kind, detail}});
}

void Witness::events(const std::vector<state::Event>& events) {
  for (const auto& event : events) {
    diary_.record_event(event);
    progress_.announce(event.kind + ": " + event.detail);
  }
}

void Witness::checkpoint_if_due(const RunState& run) {
  constexpr double interval = 30;  // wall seconds
  const double age = communicator_.max(wall_seconds() - last_checkpoint_);
  if (age > interval) checkpoint(run);
}

void Witness::checkpoint(const RunState& run) {
  save_(run);
  last_checkpoint_ = wall_seconds();
}

bool Witness::stop_wanted() const {
  return communicator_.any(stop_wanted_());
}

void Witness::show(const RunState& run, double dt, const std::string& limited_by) {
  progress_.show({name(run.stage), run.foam.time, dt, limited_by, run.foam.phases.n_bubbles(), run.ruptures,
                  fraction_done(case_, run)});
}

}  // namespace spume::simulation
