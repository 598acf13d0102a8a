#include "spume/parallel/shared_memory.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>

namespace {

using spume::parallel::Communicator;
using spume::parallel::SharedMemory;

// The ranks of a test run on one machine; only one that lacks room has nothing to show here.
TEST(SharedMemory, EveryRankReadsWhatTheOthersWroteBeforeTheyMet) {
  const Communicator world = Communicator::world();
  const auto memory = SharedMemory::among(world, 10 + 1000 * world.rank());
  if (!memory) GTEST_SKIP() << "no room for shared memory on this machine";
  for (int round = 1; round < 50; ++round) {
    const int next = (world.rank() + 1) % world.size();
    memory->part(next)[9] = 100 * round + world.rank();
    memory->synchronise();
    for (int rank = 0; rank < world.size(); ++rank)
      EXPECT_EQ(memory->part((rank + 1) % world.size())[9], 100 * round + rank);
    memory->synchronise();
  }
}

TEST(SharedMemory, StartsWithZerosOnWholeCacheLines) {
  const Communicator world = Communicator::world();
  for (int n : {1, 7, 5000}) {
    const auto memory = SharedMemory::among(world, n);
    if (!memory) GTEST_SKIP() << "no room for shared memory on this machine";
    for (int rank = 0; rank < world.size(); ++rank) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory->part(rank)) % 64, 0);
      for (int m = 0; m < n; ++m) EXPECT_EQ(memory->part(rank)[m], 0);
    }
    memory->synchronise();
  }
}

// The others do not meet it: here they keep their memory.
TEST(SharedMemory, DoesNotHoldUpARankThatFailsAlone) {
  const Communicator world = Communicator::world();
  bool has_failed = false;
  try {
    auto memory = SharedMemory::among(world, 10);
    if (world.is_root()) throw std::runtime_error("alone");
    static_cast<void>(memory.release());
  } catch (const std::runtime_error&) {
    has_failed = true;
  }
  EXPECT_EQ(has_failed, world.is_root());
  world.barrier();
}

TEST(SharedMemory, IsRefusedWhereThereIsNoRoom) {
  constexpr std::size_t more_than_any_machine = std::size_t{1} << 50;
  EXPECT_EQ(SharedMemory::among(Communicator::world(), more_than_any_machine), nullptr);
}

}  // namespace
