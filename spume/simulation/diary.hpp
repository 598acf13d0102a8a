#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "spume/mesh/topology.hpp"
#include "spume/simulation/case.hpp"
#include "spume/state/events.hpp"
#include "spume/state/foam.hpp"

namespace spume::simulation {

/// A line of history.csv beside what the foam itself tells.
struct StepRecord {
  long step = 0;
  Stage stage = Stage::Rearrange;
  double dt = 0;                  ///< [s]
  double kinetic_energy = 0;      ///< [J]
  double max_speed = 0;           ///< [m/s]
  std::string limited_by = {};    ///< what set dt
  double correction = 0;          ///< of film energy by restored volumes and reconstruction [J]
  double min_half_thickness = 0;  ///< [m]
};

/// How far each file of the diary had got; part of a checkpoint, so that a resumed run cuts them back to it.
struct DiaryMark {
  long history_rows = 0, bubble_rows = 0, lamella_rows = 0, border_rows = 0, event_rows = 0;
  int frames = 0, gas_frames = 0;
  double initial_liquid = -1;  ///< ledger at the first line [m³]; −1 before it
};

/// Writes the output folder (README, history, bubbles, lamellae, borders, events, film frames, gas frames).
/// Only rank 0 writes. Every function is Collective, and throws on all ranks (std::runtime_error) when the
/// disk refuses.
class Diary {
 public:
  /// A new run starts the files and ignores `mark`; a resumed one cuts them back to it, and throws InputError
  /// when a file has less than the mark says.
  Diary(const parallel::Communicator& communicator, const std::filesystem::path& folder, const Case& run_case,
        const DiaryMark& mark, bool resumed);
  ~Diary();

  /// One row of history.csv. The thinnest point is found here where `record.min_half_thickness` is not
  /// positive.
  void record_step(const state::Foam& foam, const mesh::Topology& topology, const StepRecord& record);
  /// One row of events.csv.
  void record_event(const state::Event& event);
  /// Frame of films.pvd with its rows of bubbles.csv, lamellae.csv and borders.csv; gas frame where the case
  /// asks. `pressure` of each phase [Pa], relative to the outside.
  void record_frame(const state::Foam& foam, const mesh::Topology& topology,
                    const std::vector<double>& pressure);

  /// How far the files are now, the same on every rank. All rows up to it are on the disk when this returns.
  DiaryMark mark() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace spume::simulation
