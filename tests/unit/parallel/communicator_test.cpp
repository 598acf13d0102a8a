#include "spume/parallel/communicator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "spume/base/error.hpp"

namespace {

using spume::InputError;
using spume::Interrupted;
using spume::NumericalError;
using spume::parallel::Communicator;

/// Type and message of what `work` throws.
template <class Work>
std::string failure_of(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return std::string("input: ") + error.what();
  } catch (const NumericalError& error) {
    return std::string("numerical: ") + error.what();
  } catch (const Interrupted& error) {
    return std::string("interrupted: ") + error.what();
  } catch (const std::runtime_error& error) {
    return std::string("other: ") + error.what();
  }
  return "none";
}

TEST(Communicator, ReducesOverRanks) {
  const Communicator world = Communicator::world();
  const int last = world.size() - 1;
  EXPECT_EQ(world.sum(world.rank() + 1.0), 0.5 * world.size() * (world.size() + 1));
  EXPECT_EQ(world.max(world.rank()), last);
  EXPECT_EQ(world.min(-world.rank()), -last);
  EXPECT_TRUE(world.any(world.rank() == last));
  EXPECT_FALSE(world.any(false));
}

TEST(Communicator, SumOfArraysIsExactWhereOneRankIsNonzero) {
  const Communicator world = Communicator::world();
  std::array<double, 7> values{};
  for (int m = 0; m < 7; ++m)
    if (m % world.size() == world.rank()) values[m] = 0.1 * (m + 1);
  world.sum(values);
  for (int m = 0; m < 7; ++m) EXPECT_EQ(values[m], 0.1 * (m + 1));
}

TEST(Communicator, GathersPartsOfAnyLengthOnEveryRank) {
  const Communicator world = Communicator::world();
  std::vector<int> offset{0};  // rank r has r numbers: the first none
  for (int r = 0; r < world.size(); ++r) offset.push_back(offset.back() + r);
  std::vector<double> values(offset.back(), -1.0);
  for (int n = offset[world.rank()]; n < offset[world.rank() + 1]; ++n) values[n] = 0.1 * n;
  world.all_gather(std::span(values), offset);
  for (int n = 0; n < offset.back(); ++n) EXPECT_EQ(values[n], 0.1 * n);
}

TEST(Communicator, JoinsPartsOfWhichSomeAreEmpty) {
  struct Item {
    char name;
    double value;
  };
  const Communicator world = Communicator::world();
  std::vector<Item> part;
  if (world.rank() % 2 == 0) part = {{'a', world.rank() + 0.5}, {'b', -1.0}};
  std::vector<int> offset;
  const auto whole = world.joined(part, offset);
  ASSERT_EQ(offset.size(), world.size() + 1u);
  for (int r = 0; r < world.size(); ++r) {
    ASSERT_EQ(offset[r + 1] - offset[r], r % 2 == 0 ? 2 : 0);
    if (r % 2 != 0) continue;
    EXPECT_EQ(whole[offset[r]].name, 'a');
    EXPECT_EQ(whole[offset[r]].value, r + 0.5);
    EXPECT_EQ(whole[offset[r] + 1].name, 'b');
  }
}

TEST(Communicator, SharesAreEvenAndCoverAll) {
  const Communicator world = Communicator::world();
  const std::vector<int> share = world.shares(3);
  EXPECT_EQ(share.front(), 0);
  EXPECT_EQ(share.back(), 3);
  for (int r = 0; r < world.size(); ++r) {
    EXPECT_GE(share[r + 1] - share[r], 3 / world.size());
    EXPECT_LE(share[r + 1] - share[r], 3 / world.size() + 1);
  }
}

TEST(Communicator, OfOneRankReducesNothing) {
  const Communicator self = Communicator::self();
  EXPECT_EQ(self.size(), 1);
  EXPECT_EQ(self.max(Communicator::world().rank()), Communicator::world().rank());
}

TEST(Communicator, BroadcastsNumbersAndTextOfAnyLength) {
  const Communicator world = Communicator::world();
  const int root = world.size() - 1;
  std::array<double, 2> values{};
  std::string text = "what a receiver held before";
  if (world.rank() == root) {
    values = {1.5, -2.5};
    text = "η = 3e-6";
  }
  world.broadcast(values, root);
  world.broadcast(text, root);
  EXPECT_EQ(values, (std::array<double, 2>{1.5, -2.5}));
  EXPECT_EQ(text, "η = 3e-6");
}

TEST(Communicator, WorkOnRootRunsThereOnly) {
  const Communicator world = Communicator::world();
  double runs = 0;
  world.on_root([&] { runs += 1; });
  EXPECT_EQ(runs, world.is_root() ? 1 : 0);
  EXPECT_EQ(world.sum(runs), 1);
}

TEST(Communicator, FailureOnRootIsThrownOnEveryRankWithItsTypeAndMessage) {
  const Communicator world = Communicator::world();
  EXPECT_EQ(failure_of([&] { world.on_root([] { throw InputError("no such key"); }); }),
            "input: no such key");
  EXPECT_EQ(failure_of([&] { world.on_root([] { throw NumericalError("NaN"); }); }), "numerical: NaN");
  EXPECT_EQ(failure_of([&] { world.on_root([] { throw Interrupted("signal"); }); }), "interrupted: signal");
  EXPECT_EQ(failure_of([&] { world.on_root([] { throw std::logic_error("bug"); }); }), "other: bug");
  EXPECT_EQ(failure_of([&] { world.on_root([] { throw 1; }); }), "other: unknown exception");
}

TEST(Communicator, LowestFailingRankSpeaksForAll) {
  const Communicator world = Communicator::world();
  const int first = world.size() / 2;
  const auto work = [&] {
    if (world.rank() == first) throw NumericalError("rank " + std::to_string(first));
    if (world.rank() > first) throw InputError("a higher rank");
  };
  EXPECT_EQ(failure_of([&] { world.together(work); }), "numerical: rank " + std::to_string(first));
}

TEST(Communicator, WorkTogetherWithoutFailureReturns) {
  const Communicator world = Communicator::world();
  int done = 0;
  EXPECT_EQ(failure_of([&] { world.together([&] { done = 1; }); }), "none");
  EXPECT_EQ(done, 1);
}

}  // namespace
