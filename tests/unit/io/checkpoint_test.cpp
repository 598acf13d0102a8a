#include "spume/io/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spume/base/error.hpp"
#include "spume/grid/loops.hpp"
#include "spume/mesh/topology.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace spume::io {
namespace {

using testing::ScratchFolder;

grid::Box box_of(int nx) {
  return {{0, 0, 0}, {1e-3, 1e-3 * 10 / nx, 1e-3 * 12 / nx}, {nx, 10, 12}};
}

/// A foam whose numbers are all different and use all their bits.
void fill(state::Foam& foam) {
  foam.time = 1.0 / 3;
  foam.films = shapes::four_bubbles(1e-3 / 3, 3);
  const auto topology = mesh::build_topology(foam.films);
  foam.phases.target_volume = {0, 1e-9 / 3, 0, 1e-9 / 7, 5e-324};
  foam.phases.above_membrane = 3;
  for (std::size_t d = 0; d < topology.film_dof.size(); ++d)
    foam.liquid.lamella_volume.push_back(1e-14 / (d + 3));
  for (std::size_t d = 0; d < topology.border_dof.size(); ++d)
    foam.liquid.border_volume.push_back(1e-13 / (d + 3));
  foam.liquid.lamella_is_young = {0, 1, 1, 0};
  foam.liquid.lamella_area_at_transfer = {1e-6 / 3, -0.0, std::numeric_limits<double>::infinity()};
  foam.liquid.sprayed = 1e-15 / 3;
  for (int axis = 0; axis < 3; ++axis) {
    auto u = grid::owned(foam.gas.velocity[axis]);
    grid::for_each_cell(foam.gas.pressure.grid(), [&](int i, int j, int k) {
      u(i, j, k) = std::sin(i + 20 * j + 300 * k + 0.1 * axis);
    });
  }
  auto p = grid::owned(foam.gas.pressure);
  grid::for_each_cell(foam.gas.pressure.grid(),
                      [&](int i, int j, int k) { p(i, j, k) = std::cos(i + 20 * j + 300 * k); });
}

void expect_same_bits(const state::Foam& a, const state::Foam& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.films.position, b.films.position);
  ASSERT_EQ(a.films.triangle.size(), b.films.triangle.size());
  for (std::size_t t = 0; t < a.films.triangle.size(); ++t) {
    EXPECT_EQ(a.films.triangle[t].vertex, b.films.triangle[t].vertex);
    EXPECT_EQ(a.films.triangle[t].phase_a, b.films.triangle[t].phase_a);
    EXPECT_EQ(a.films.triangle[t].phase_b, b.films.triangle[t].phase_b);
  }
  EXPECT_EQ(a.phases.target_volume, b.phases.target_volume);
  EXPECT_EQ(a.phases.above_membrane, b.phases.above_membrane);
  EXPECT_EQ(a.liquid.lamella_volume, b.liquid.lamella_volume);
  EXPECT_EQ(a.liquid.border_volume, b.liquid.border_volume);
  EXPECT_EQ(a.liquid.lamella_is_young, b.liquid.lamella_is_young);
  EXPECT_EQ(a.liquid.lamella_area_at_transfer, b.liquid.lamella_area_at_transfer);
  EXPECT_EQ(a.liquid.sprayed, b.liquid.sprayed);
  const auto same = [](const grid::Field& f, const grid::Field& g) {
    return std::equal(f.values().begin(), f.values().end(), g.values().begin(), g.values().end());
  };
  for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(same(a.gas.velocity[axis], b.gas.velocity[axis]));
  EXPECT_TRUE(same(a.gas.pressure, b.gas.pressure));
}

TEST(Checkpoint, ReadsBackBitForBitOnEveryRank) {
  const ScratchFolder folder;
  const grid::Grid grid(parallel::Communicator::world(), box_of(9));
  state::Foam foam(grid), again(grid);
  fill(foam);
  CheckpointExtras extras;
  extras.numbers = {{"stage", 2}, {"a third", 1.0 / 3}};
  extras.lists = {{"none", {}}, {"some", {1.0 / 7, -1, 5e-324}}};
  EXPECT_FALSE(has_checkpoint(folder.path()));
  save_checkpoint(folder.path(), foam, extras);
  EXPECT_TRUE(has_checkpoint(folder.path()));

  const CheckpointExtras extras_again = load_checkpoint(folder.path(), again);
  expect_same_bits(foam, again);
  EXPECT_EQ(extras_again.numbers, extras.numbers);
  EXPECT_EQ(extras_again.lists, extras.lists);
}

TEST(Checkpoint, ReadsBackOnAnotherNumberOfRanks) {
  const ScratchFolder folder;
  const auto world = parallel::Communicator::world();
  const grid::Grid grid(world, box_of(9));
  state::Foam foam(grid), again(grid);
  fill(foam);
  if (world.is_root()) {
    const grid::Grid alone(parallel::Communicator(MPI_COMM_SELF), box_of(9));
    state::Foam whole(alone);
    fill(whole);
    save_checkpoint(folder.path(), whole, {});
  }
  world.barrier();
  load_checkpoint(folder.path(), again);
  expect_same_bits(foam, again);
}

TEST(Checkpoint, SecondOneReplacesTheFirst) {
  const ScratchFolder folder;
  const grid::Grid grid(parallel::Communicator::world(), box_of(9));
  state::Foam foam(grid), again(grid);
  fill(foam);
  save_checkpoint(folder.path(), foam, {});
  foam.time = 2;
  foam.films = shapes::sphere({0, 0, 0}, 1e-4, 1, 1);
  foam.liquid = {};
  save_checkpoint(folder.path(), foam, {{{"n", 2}}, {}});
  EXPECT_EQ(load_checkpoint(folder.path(), again).numbers.at("n"), 2);
  expect_same_bits(foam, again);
}

TEST(Checkpoint, OneThatWasCutShortIsNotFound) {
  const ScratchFolder folder;
  const auto world = parallel::Communicator::world();
  const grid::Grid grid(world, box_of(9));
  state::Foam foam(grid), again(grid);
  fill(foam);
  save_checkpoint(folder.path(), foam, {});
  world.on_root([&] {  // as a kill leaves it while the next one is being written
    std::filesystem::create_directory(folder.path() / "checkpoint.new");
    std::ofstream(folder.path() / "checkpoint.new" / "state.h5") << "half a file";
  });
  load_checkpoint(folder.path(), again);
  expect_same_bits(foam, again);
  save_checkpoint(folder.path(), foam, {});
  load_checkpoint(folder.path(), again);
}

TEST(Checkpoint, FailsOnAllRanksWhereThereIsNoneOrTheBoxIsAnother) {
  const ScratchFolder folder;
  const auto world = parallel::Communicator::world();
  const grid::Grid grid(world, box_of(9)), other(world, box_of(8));
  state::Foam foam(grid), elsewhere(other);
  fill(foam);
  EXPECT_THROW(load_checkpoint(folder.path(), foam), InputError);
  save_checkpoint(folder.path(), foam, {});
  EXPECT_THROW(load_checkpoint(folder.path(), elsewhere), InputError);
  EXPECT_THROW(save_checkpoint(folder.path() / "missing", foam, {}), std::runtime_error);
}

TEST(Checkpoint, DamagedStateIsAnErrorOnAllRanks) {
  const ScratchFolder folder;
  const auto world = parallel::Communicator::world();
  const grid::Grid grid(world, box_of(9));
  state::Foam foam(grid);
  fill(foam);
  save_checkpoint(folder.path(), foam, {});
  world.on_root([&] { std::filesystem::resize_file(folder.path() / "checkpoint" / "state.h5", 2000); });
  EXPECT_THROW(load_checkpoint(folder.path(), foam), std::runtime_error);
}

}  // namespace
}  // namespace spume::io
