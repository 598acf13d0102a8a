#pragma once

#include <functional>
#include <string>

#include "spume/mesh/topology.hpp"
#include "spume/simulation/diary.hpp"
#include "spume/simulation/progress.hpp"
#include "spume/simulation/run_state.hpp"
#include "spume/state/events.hpp"

namespace spume::simulation {

/// What watches a run and may stop it: the diary, the live line, checkpoints and the user's wish to stop. The
/// stages know nothing else of the world outside.
class Witness {
 public:
  Witness(const parallel::Communicator& communicator, const Case& run_case, Diary& diary,
          ProgressLine& progress, std::function<void(const RunState&)> save,
          std::function<bool()> stop_wanted);

  /// After each step of a stage: a line of history.csv and the live line. Collective.
  void step(RunState& run, const mesh::Topology& topology, StepRecord record, const std::string& limited_by);
  /// A frame, unless this very state has one; the next is due after `interval` [s] of simulated time.
  /// Collective.
  void frame(RunState& run, const mesh::Topology& topology, double interval);
  void frame_if_due(RunState& run, const mesh::Topology& topology, double interval);
  void event(const RunState& run, const std::string& kind, const std::string& detail);
  void events(const std::vector<state::Event>& events);
  /// Writes a checkpoint when the last is older than half a minute of wall time. Collective.
  void checkpoint_if_due(const RunState& run);
  void checkpoint(const RunState& run);
  /// The user asked to stop; the same answer on every rank. Collective.
  bool stop_wanted() const;

 private:
  void show(const RunState& run, double dt, const std::string& limited_by);

  const parallel::Communicator communicator_;
  const Case& case_;
  Diary& diary_;
  ProgressLine& progress_;
  std::function<void(const RunState&)> save_;
  std::function<bool()> stop_wanted_;
  double last_checkpoint_;
};

}  // namespace spume::simulation
