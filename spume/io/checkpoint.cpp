#include "spume/io/checkpoint.hpp"

#include <fmt/format.h>

#include <array>

#include "spume/base/contract.hpp"
#include "spume/base/error.hpp"
#include "spume/io/checkpoint_folders.hpp"
#include "spume/io/hdf5_file.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::io {

namespace {

constexpr int format_version = 2;
constexpr const char* state_file = "state.h5";
constexpr std::array velocity_names{"gas/velocity_x", "gas/velocity_y", "gas/velocity_z"};
constexpr const char* pressure_name = "gas/pressure";

// The mesh as flat arrays
// ----------------------------------------------------------------------------------------

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const Vec3& x : points) values.insert(values.end(), {x.x, x.y, x.z});
  return values;
}

std::vector<int> flat(const std::vector<mesh::FilmTriangle>& triangles) {
  std::vector<int> values;
  values.reserve(5 * triangles.size());
  for (const auto& t : triangles)
    values.insert(values.end(), {t.vertex[0], t.vertex[1], t.vertex[2], t.phase_a, t.phase_b});
  return values;
}

std::vector<Vec3> points_of(const std::vector<double>& values) {
  std::vector<Vec3> points;
  points.reserve(values.size() / 3);
  for (std::size_t n = 0; n + 2 < values.size(); n += 3)
    points.push_back({values[n], values[n + 1], values[n + 2]});
  return points;
}

std::vector<mesh::FilmTriangle> triangles_of(const std::vector<int>& values) {
  std::vector<mesh::FilmTriangle> triangles;
  triangles.reserve(values.size() / 5);
  for (std::size_t n = 0; n + 4 < values.size(); n += 5)
    triangles.push_back({{values[n], values[n + 1], values[n + 2]}, values[n + 3], values[n + 4]});
  return triangles;
}

// Writing
// --------------------------------------------------------------------------------------------------------

void write_list(const Hdf5File& file, const std::string& name, const std::vector<double>& values) {
  file.write(name, values, {values.size()});
}
void write_number(const Hdf5File& file, const std::string& name, double value) {
  file.write(name, std::span(&value, 1), {});
}

void write_films_and_liquid(const Hdf5File& file, const state::Foam& foam) {
  const auto& position = foam.films.position;
  const auto& triangle = foam.films.triangle;
  file.write("films/position", flat(position), {position.size(), 3});
  file.write("films/triangle", flat(triangle), {triangle.size(), 5});
  write_list(file, "phases/target_volume", foam.phases.target_volume);
  write_number(file, "phases/above_membrane", foam.phases.above_membrane);
  const state::FilmLiquid& liquid = foam.liquid;
  write_list(file, "liquid/lamella_volume", liquid.lamella_volume);
  write_list(file, "liquid/border_volume", liquid.border_volume);
  const std::vector<int> young(liquid.lamella_is_young.begin(), liquid.lamella_is_young.end());
  file.write("liquid/lamella_is_young", young, {young.size()});
  write_list(file, "liquid/lamella_area_at_transfer", liquid.lamella_area_at_transfer);
  write_number(file, "liquid/sprayed", liquid.sprayed);
}

void write_grid(const Hdf5File& file, const grid::Box& box) {
  const std::array cells{box.cells.i, box.cells.j, box.cells.k};
  file.write("grid/cells", cells, {3});
  file.write("grid/lower", flat({box.lower}), {3});
  file.write("grid/upper", flat({box.upper}), {3});
}

void write_extras(const Hdf5File& file, const CheckpointExtras& extras) {
  const auto check_name = [](const std::string& name) {
    expects(!name.empty() && name.find('/') == std::string::npos,
            "a name in a checkpoint is not empty and has no '/'");
  };
  file.create_group("extras");
  file.create_group("extras/numbers");
  file.create_group("extras/lists");
  for (const auto& [name, value] : extras.numbers) {
    check_name(name);
    write_number(file, "extras/numbers/" + name, value);
  }
  for (const auto& [name, values] : extras.lists) {
    check_name(name);
    write_list(file, "extras/lists/" + name, values);
  }
}

struct WholeGas {
  std::array<std::vector<double>, 3> velocity;
  std::vector<double> pressure;
};

void write_state(const std::filesystem::path& path, const state::Foam& foam, const WholeGas& gas,
                 const CheckpointExtras& extras) {
  Hdf5File file = Hdf5File::create(path);
  file.write("format", std::span(&format_version, 1), {});
  write_number(file, "time", foam.time);
  const grid::Box& box = foam.gas.pressure.grid().box();
  write_grid(file, box);
  write_films_and_liquid(file, foam);
  const std::vector<std::size_t> shape{static_cast<std::size_t>(box.cells.k),
                                       static_cast<std::size_t>(box.cells.j),
                                       static_cast<std::size_t>(box.cells.i)};
  for (int axis = 0; axis < 3; ++axis) file.write(velocity_names[axis], gas.velocity[axis], shape);
  file.write(pressure_name, gas.pressure, shape);
  write_extras(file, extras);
  file.close();
}

// Reading
// --------------------------------------------------------------------------------------------------------

void check_fits(const Hdf5File& file, const grid::Box& box) {
  const int format = file.read_int("format").at(0);
  if (format != format_version)
    throw InputError(
        fmt::format("checkpoint: written in format {}, this program reads {}", format, format_version));
  const auto n = file.read_int("grid/cells");
  if (n != std::vector<int>{box.cells.i, box.cells.j, box.cells.k})
    throw InputError(fmt::format("checkpoint: it has {} × {} × {} cells, the case {} × {} × {}", n.at(0),
                                 n.at(1), n.at(2), box.cells.i, box.cells.j, box.cells.k));
  if (file.read("grid/lower") != flat({box.lower}) || file.read("grid/upper") != flat({box.upper}))
    throw InputError("checkpoint: its box is not the box of the case");
}

/// All that is in the file, as flat arrays; `numbers` first and in this order, so that one loop sends it to
/// all ranks.
struct Contents {
  std::vector<double> scalars;  ///< time, sprayed, phase above the membrane
  std::vector<double> position, target_volume, lamella_volume, border_volume, area_at_transfer;
  std::vector<double> triangle, is_young;  ///< integers; doubles hold them exactly
  WholeGas gas;
  std::vector<double> extra_numbers, extra_list_lengths, extra_list_values;
  std::string extra_names;  ///< one a line, numbers then lists

  std::vector<std::vector<double>*> arrays() {
    return {&scalars,          &position,     &target_volume, &lamella_volume,     &border_volume,
            &area_at_transfer, &triangle,     &is_young,      &gas.velocity[0],    &gas.velocity[1],
            &gas.velocity[2],  &gas.pressure, &extra_numbers, &extra_list_lengths, &extra_list_values};
  }
};

void read_extras(const Hdf5File& file, Contents& contents) {
  for (const auto& name : file.names("extras/numbers")) {
    contents.extra_names += name + '\n';
    contents.extra_numbers.push_back(file.read("extras/numbers/" + name).at(0));
  }
  for (const auto& name : file.names("extras/lists")) {
    contents.extra_names += name + '\n';
    const auto values = file.read("extras/lists/" + name);
    contents.extra_list_lengths.push_back(static_cast<double>(values.size()));
    contents.extra_list_values.insert(contents.extra_list_values.end(), values.begin(), values.end());
  }
}

Contents read_state(const std::filesystem::path& path, const grid::Box& box) {
  const Hdf5File file = Hdf5File::open(path);
  check_fits(file, box);
  Contents contents;
  contents.scalars = {file.read("time").at(0), file.read("liquid/sprayed").at(0),
                      file.read("phases/above_membrane").at(0)};
  contents.position = file.read("films/position");
  contents.triangle = file.read("films/triangle");
  contents.target_volume = file.read("phases/target_volume");
  contents.lamella_volume = file.read("liquid/lamella_volume");
  contents.border_volume = file.read("liquid/border_volume");
  contents.is_young = file.read("liquid/lamella_is_young");
  contents.area_at_transfer = file.read("liquid/lamella_area_at_transfer");
  for (int axis = 0; axis < 3; ++axis) contents.gas.velocity[axis] = file.read(velocity_names[axis]);
  contents.gas.pressure = file.read(pressure_name);
  read_extras(file, contents);
  return contents;
}

void send_to_all(const parallel::Communicator& communicator, Contents& contents) {
  for (std::vector<double>* array : contents.arrays()) {
    double n = static_cast<double>(array->size());
    communicator.broadcast(std::span(&n, 1));
    array->resize(static_cast<std::size_t>(n));
    communicator.broadcast(*array);
  }
  communicator.broadcast(contents.extra_names);
}

void unpack_foam(const Contents& contents, state::Foam& foam) {
  foam.time = contents.scalars.at(0);
  foam.films.position = points_of(contents.position);
  foam.films.triangle = triangles_of({contents.triangle.begin(), contents.triangle.end()});
  foam.phases.target_volume = contents.target_volume;
  foam.phases.above_membrane = static_cast<mesh::Phase>(contents.scalars.at(2));
  foam.liquid.sprayed = contents.scalars.at(1);
  foam.liquid.lamella_volume = contents.lamella_volume;
  foam.liquid.border_volume = contents.border_volume;
  foam.liquid.lamella_is_young.assign(contents.is_young.begin(), contents.is_young.end());
  foam.liquid.lamella_area_at_transfer = contents.area_at_transfer;
  for (int axis = 0; axis < 3; ++axis) grid::scatter(contents.gas.velocity[axis], foam.gas.velocity[axis]);
  grid::scatter(contents.gas.pressure, foam.gas.pressure);
}

CheckpointExtras unpack_extras(const Contents& contents) {
  CheckpointExtras extras;
  std::size_t line = 0;
  const auto next_name = [&] {
    const std::size_t end = contents.extra_names.find('\n', line);
    const std::string name = contents.extra_names.substr(line, end - line);
    line = end + 1;
    return name;
  };
  for (double number : contents.extra_numbers) extras.numbers[next_name()] = number;
  auto value = contents.extra_list_values.begin();
  for (double length : contents.extra_list_lengths) {
    const auto end = value + static_cast<std::ptrdiff_t>(length);
    extras.lists[next_name()].assign(value, end);
    value = end;
  }
  return extras;
}

}  // namespace

void save_checkpoint(const std::filesystem::path& folder, const state::Foam& foam,
                     const CheckpointExtras& extras) {
  WholeGas gas;
  for (int axis = 0; axis < 3; ++axis) gas.velocity[axis] = grid::gather(foam.gas.velocity[axis]);
  gas.pressure = grid::gather(foam.gas.pressure);
  foam.gas.pressure.grid().communicator().on_root([&] {
    CheckpointFolders(folder).replace(
        [&](const std::filesystem::path& empty) { write_state(empty / state_file, foam, gas, extras); });
  });
}

CheckpointExtras load_checkpoint(const std::filesystem::path& folder, state::Foam& foam) {
  const grid::Grid& grid = foam.gas.pressure.grid();
  Contents contents;
  grid.communicator().on_root([&] {
    const auto checkpoint = CheckpointFolders(folder).complete();
    if (!checkpoint) throw InputError(fmt::format("{}: holds no complete checkpoint", folder.string()));
    contents = read_state(*checkpoint / state_file, grid.box());
  });
  send_to_all(grid.communicator(), contents);
  unpack_foam(contents, foam);
  return unpack_extras(contents);
}

bool has_checkpoint(const std::filesystem::path& folder) {
  return CheckpointFolders(folder).complete().has_value();
}

}  // namespace spume::io
