#include "spume/config/nearest.hpp"

#include <gmock/gmock.h>

namespace spume::config {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EditDistance, counts_insertions_deletions_replacements_and_swaps_of_neighbours) {
  EXPECT_EQ(edit_distance("viscosity", "viscosity"), 0);
  EXPECT_EQ(edit_distance("viscocity", "viscosity"), 1);
  EXPECT_EQ(edit_distance("visosity", "viscosity"), 1);
  EXPECT_EQ(edit_distance("visccosity", "viscosity"), 1);
  EXPECT_EQ(edit_distance("vicsosity", "viscosity"), 1);
  EXPECT_EQ(edit_distance("", "cfl"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

const std::vector<std::string> keys{"gas.density",           "gas.viscosity",        "liquid.density",
                                    "liquid.viscosity",      "film.surface_tension", "drainage.max_time",
                                    "rearrangement.max_time"};

TEST(NearestNames, finds_a_misspelt_key_of_the_same_section) {
  EXPECT_THAT(nearest_names("gas.densty", keys), ElementsAre("gas.density"));
  EXPECT_THAT(nearest_names("drainage.maxtime", keys), ElementsAre("drainage.max_time"));
}

TEST(NearestNames, finds_a_key_that_stands_in_another_section) {
  EXPECT_THAT(nearest_names("liquid.surface_tension", keys), ElementsAre("film.surface_tension"));
  EXPECT_THAT(nearest_names("viscosity", keys), ElementsAre("gas.viscosity", "liquid.viscosity"));
}

TEST(NearestNames, finds_nothing_for_another_word) {
  EXPECT_THAT(nearest_names("gas.temperature", keys), IsEmpty());
  EXPECT_EQ(did_you_mean({}), "");
}

TEST(DidYouMean, lists_all_names) {
  EXPECT_EQ(did_you_mean({"a", "b", "c"}), "; did you mean 'a', 'b' or 'c'?");
}

}  // namespace
}  // namespace spume::config
