#include "spume/simulation/diary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>

#include "spume/io/csv_table.hpp"
#include "spume/io/durable.hpp"
#include "spume/io/film_frame.hpp"
#include "spume/io/pvd_series.hpp"
#include "spume/io/rasterize.hpp"
#include "spume/io/vtk_films.hpp"
#include "spume/io/vtk_gas.hpp"
#include "spume/simulation/diary_files.hpp"
#include "spume/simulation/diary_rows.hpp"

namespace spume::simulation {

namespace {

namespace fs = std::filesystem;

std::string frame_name(const std::string& series, int frame, const std::string& ending) {
  return fmt::format("{0}/{0}_{1:06}.{2}", series, frame, ending);
}

/// Makes the folder of a series, and removes frames that do not count any more and halves of frames.
void prepare_frames(const fs::path& folder, const std::string& series, const std::string& ending,
                    int n_frames) {
  fs::create_directories(folder / series);
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(folder / series)) {
    const std::string name = entry.path().filename().string();
    const std::size_t start = series.size() + 1;
    if (name.rfind(series + "_", 0) != 0 || !entry.is_regular_file()) continue;
    int frame = -1;
    std::from_chars(name.data() + start, name.data() + name.size(), frame);
    if (frame >= n_frames || entry.path().extension() != "." + ending) stale.push_back(entry.path());
  }
  for (const auto& path : stale) fs::remove(path);
}

/// The files of the diary, on rank 0.
struct Files {
  Files(const fs::path& folder, const DiaryMark& mark, bool resumed, bool gas)
      : history(table(folder / "history.csv", history_columns(), mark.history_rows, resumed)),
        bubbles(table(folder / "bubbles.csv", bubble_columns(), mark.bubble_rows, resumed)),
        lamellae(table(folder / "lamellae.csv", lamella_columns(), mark.lamella_rows, resumed)),
        borders(table(folder / "borders.csv", border_columns(), mark.border_rows, resumed)),
        events(table(folder / "events.csv", event_columns(), mark.event_rows, resumed)),
        films(series(folder / "films.pvd", mark.frames, resumed)) {
    // A case that asks for the gas only after it was resumed starts this series then.
    if (gas) gas_frames.emplace(series(folder / "gas.pvd", mark.gas_frames, resumed && mark.gas_frames > 0));
  }

  static io::CsvTable table(const fs::path& path, std::span<const io::Column> columns, long rows,
                            bool resumed) {
    return resumed ? io::CsvTable(path, columns, rows) : io::CsvTable(path, columns);
  }
  static io::PvdSeries series(const fs::path& path, int n_frames, bool resumed) {
    return resumed ? io::PvdSeries(path, n_frames) : io::PvdSeries(path);
  }
  void put_on_disk() {
    for (io::CsvTable* table : {&history, &bubbles, &lamellae, &borders, &events}) table->put_on_disk();
  }

  io::CsvTable history, bubbles, lamellae, borders, events;
  io::PvdSeries films;
  std::optional<io::PvdSeries> gas_frames;
};

/// The gas as the case wants to see it, whole on every rank. Collective.
io::GasFrame gather_gas(const state::Foam& foam, const std::vector<std::string>& fields, bool is_root) {
  const auto wanted = [&](const char* field) {
    return std::find(fields.begin(), fields.end(), field) != fields.end();
  };
  const grid::Box& box = foam.gas.pressure.grid().box();
  io::GasFrame frame;
  frame.time = foam.time;
  if (wanted("velocity"))
    for (int axis = 0; axis < 3; ++axis) frame.velocity[axis] = grid::gather(foam.gas.velocity[axis]);
  if (wanted("pressure")) frame.pressure = grid::gather(foam.gas.pressure);
  if (is_root && wanted("phase")) frame.phase = io::rasterize_phases(foam.films, foam.phases.count(), box);
  if (is_root && wanted("distance"))
    frame.distance = io::rasterize_distance(foam.films, box, norm(box.size()));
  return frame;
}

}  // namespace

struct Diary::Implementation {
  parallel::Communicator communicator;
  fs::path folder;
  OutputParameters output;
  DiaryMark mark;              ///< the same on every rank
  std::optional<Files> files;  ///< on rank 0

  void append(io::CsvTable Files::*table, const std::vector<Row>& rows) {
    for (const Row& row : rows) ((*files).*table).append(row);
  }
};

Diary::Diary(const parallel::Communicator& communicator, const fs::path& folder, const Case& run_case,
             const DiaryMark& mark, bool resumed)
    : implementation_(new Implementation{communicator, folder, run_case.output, mark, std::nullopt}) {
  auto& self = *implementation_;
  if (!resumed) self.mark = {};
  communicator.on_root([&] {
    prepare_frames(folder, "films", "vtp", self.mark.frames);
    if (self.output.gas) prepare_frames(folder, "gas", "vti", self.mark.gas_frames);
    self.files.emplace(folder, self.mark, resumed, self.output.gas);
    if (!resumed) io::write_text_durably(folder / "README.txt", explain_output());
  });
}

Diary::~Diary() = default;

void Diary::record_step(const state::Foam& foam, const mesh::Topology& topology, const StepRecord& record) {
  auto& self = *implementation_;
  if (self.mark.initial_liquid < 0) self.mark.initial_liquid = foam.liquid.total() + foam.liquid.sprayed;
  self.communicator.on_root(
      [&] { self.files->history.append(history_row(foam, topology, record, self.mark.initial_liquid)); });
  ++self.mark.history_rows;
}

void Diary::record_event(const state::Event& event) {
  auto& self = *implementation_;
  self.communicator.on_root([&] { self.files->events.append({event.time, event.kind, event.detail}); });
  ++self.mark.event_rows;
}

void Diary::record_frame(const state::Foam& foam, const mesh::Topology& topology,
                         const std::vector<double>& pressure) {
  auto& self = *implementation_;
  DiaryMark& mark = self.mark;
  self.communicator.on_root([&] {
    self.append(&Files::bubbles, bubble_rows(foam, topology, pressure));
    self.append(&Files::lamellae, lamella_rows(foam, topology));
    self.append(&Files::borders, border_rows(foam, topology));
    const std::string name = frame_name("films", mark.frames, "vtp");
    io::write_films(io::film_frame(foam.films, topology, foam.liquid, foam.time), self.folder / name);
    self.files->films.append(foam.time, name);
  });
  mark.bubble_rows += foam.phases.n_bubbles();
  mark.lamella_rows += topology.n_lamellae();
  mark.border_rows += topology.n_borders();
  ++mark.frames;

  if (!self.output.gas) return;
  const io::GasFrame gas = gather_gas(foam, self.output.fields, self.communicator.is_root());
  self.communicator.on_root([&] {
    const std::string name = frame_name("gas", mark.gas_frames, "vti");
    io::write_gas(gas, foam.gas.pressure.grid().box(), self.folder / name);
    self.files->gas_frames->append(foam.time, name);
  });
  ++mark.gas_frames;
}

DiaryMark Diary::mark() const {
  implementation_->communicator.on_root([&] { implementation_->files->put_on_disk(); });
  return implementation_->mark;
}

}  // namespace spume::simulation
