#include "spume/base/flat_map.hpp"

#include <gtest/gtest.h>

#include <map>

#include "spume/base/random.hpp"

namespace spume {
namespace {

/// Sends many keys to few places, so that runs of taken places form.
struct PoorHash {
  std::size_t operator()(int key) const { return static_cast<std::size_t>(key) % 64; }
};

TEST(FlatMap, GivesEveryKeyTheNumberOfItsFirstInsertionThroughCollisionsAndGrowth) {
  FlatMap<int, PoorHash> map;
  std::map<int, int> reference;
  Random random(3);
  for (int n = 0; n < 3000; ++n) {
    const int key = static_cast<int>(random.uniform(0, 1200));
    const int expected = reference.emplace(key, n).first->second;
    ASSERT_EQ(map.find_or_insert(key, n), expected);
  }
  EXPECT_GT(reference.size(), 1000u);
}

}  // namespace
}  // namespace spume
