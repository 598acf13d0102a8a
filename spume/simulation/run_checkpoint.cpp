#include "spume/simulation/run_checkpoint.hpp"

#include "spume/base/error.hpp"
#include "spume/io/checkpoint.hpp"

namespace spume::simulation {

namespace {

std::vector<double> flatten(const std::vector<Vec3>& points) {
  std::vector<double> flat;
  flat.reserve(3 * points.size());
  for (const auto& x : points) flat.insert(flat.end(), {x.x, x.y, x.z});
  return flat;
}

std::vector<Vec3> points_of(const std::vector<double>& flat) {
  std::vector<Vec3> points(flat.size() / 3);
  for (std::size_t p = 0; p < points.size(); ++p) points[p] = {flat[3 * p], flat[3 * p + 1], flat[3 * p + 2]};
  return points;
}

template <class Value>
Value find(const std::map<std::string, Value>& values, const char* name,
           const std::filesystem::path& folder) {
  const auto found = values.find(name);
  if (found == values.end())
    throw InputError("the checkpoint in " + folder.string() + " lacks '" + name +
                     "'; it is of another version of spume");
  return found->second;
}

}  // namespace

void save(const std::filesystem::path& folder, const RunState& run, const DiaryMark& mark) {
  io::CheckpointExtras extras;
  extras.numbers = {{"stage", static_cast<double>(run.stage)},
                    {"step", static_cast<double>(run.step)},
                    {"ruptures", run.ruptures},
                    {"bubbles_at_start", run.bubbles_at_start},
                    {"next_frame", run.next_frame},
                    {"has_frame", run.has_frame},
                    {"finished", run.finished},
                    {"rearrange_elapsed", run.rearrange.elapsed},
                    {"steps_since_reconstruction", run.rearrange.steps_since_reconstruction},
                    {"history_rows", static_cast<double>(mark.history_rows)},
                    {"bubble_rows", static_cast<double>(mark.bubble_rows)},
                    {"lamella_rows", static_cast<double>(mark.lamella_rows)},
                    {"border_rows", static_cast<double>(mark.border_rows)},
                    {"event_rows", static_cast<double>(mark.event_rows)},
                    {"frames", mark.frames},
                    {"gas_frames", mark.gas_frames},
                    {"initial_liquid", mark.initial_liquid}};
  extras.lists = {{"reference", flatten(run.rearrange.reference)},
                  {"recent_time", run.rearrange.recent_time},
                  {"recent_kinetic_energy", run.rearrange.recent_kinetic_energy},
                  {"recent_area", run.rearrange.recent_area},
                  {"recent_virial", run.rearrange.recent_virial}};
  io::save_checkpoint(folder, run.foam, extras);
}

DiaryMark load(const std::filesystem::path& folder, RunState& run) {
  const io::CheckpointExtras extras = io::load_checkpoint(folder, run.foam);
  const auto number = [&](const char* name) { return find(extras.numbers, name, folder); };
  const auto count = [&](const char* name) { return static_cast<long>(number(name)); };
  const auto list = [&](const char* name) { return find(extras.lists, name, folder); };
  const long stage = count("stage");
  if (stage < 0 || stage > static_cast<long>(Stage::Rupture))
    throw InputError("the checkpoint in " + folder.string() + " names no stage of this program");
  run.stage = static_cast<Stage>(stage);
  run.step = count("step");
  run.ruptures = static_cast<int>(count("ruptures"));
  run.bubbles_at_start = static_cast<int>(count("bubbles_at_start"));
  run.next_frame = number("next_frame");
  run.has_frame = count("has_frame") != 0;
  run.finished = count("finished") != 0;
  run.rearrange.elapsed = number("rearrange_elapsed");
  run.rearrange.steps_since_reconstruction = static_cast<int>(count("steps_since_reconstruction"));
  run.rearrange.reference = points_of(list("reference"));
  run.rearrange.recent_time = list("recent_time");
  run.rearrange.recent_kinetic_energy = list("recent_kinetic_energy");
  run.rearrange.recent_area = list("recent_area");
  run.rearrange.recent_virial = list("recent_virial");
  return {count("history_rows"),
          count("bubble_rows"),
          count("lamella_rows"),
          count("border_rows"),
          count("event_rows"),
          static_cast<int>(count("frames")),
          static_cast<int>(count("gas_frames")),
          number("initial_liquid")};
}

}  // namespace spume::simulation
