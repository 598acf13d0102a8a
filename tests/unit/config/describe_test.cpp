#include "spume/config/describe.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "spume/base/error.hpp"
#include "spume/config/keys.hpp"

namespace spume::config {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Describe, names_every_key_with_its_meaning) {
  const std::string text = describe();
  for (const auto& key : case_keys())
    EXPECT_THAT(text, AllOf(HasSubstr(leaf_of(key.name)), HasSubstr(key.meaning)));
  for (const auto& key : bubble_keys()) EXPECT_THAT(text, HasSubstr(key.meaning));
  for (const auto& section : sections()) EXPECT_THAT(text, HasSubstr(section.meaning));
}

TEST(Describe, shows_unit_default_range_and_symbol_of_one_section) {
  const std::string text = describe("liquid");
  EXPECT_THAT(text, HasSubstr("density    1000     kg/m³  > 0    ρ       density of the liquid"));
  EXPECT_THAT(text, Not(HasSubstr("[gas]")));
}

TEST(Describe, shows_the_list_of_bubbles_with_the_foam) {
  EXPECT_THAT(describe("foam"),
              AllOf(HasSubstr("[foam]"), HasSubstr("[[foam.bubble]]"), HasSubstr("semi_axes")));
  EXPECT_THAT(describe("foam.cluster"), HasSubstr("mean_diameter"));
}

TEST(Describe, refuses_an_unknown_section_with_the_nearest) {
  try {
    describe("drainge");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "no section 'drainge'; did you mean 'drainage'?");
  }
}

TEST(Keys, have_sections_units_in_si_and_distinct_names) {
  std::set<std::string> names;
  for (const auto& key : case_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_TRUE(std::ranges::any_of(sections(), [&](const auto& s) {
      return s.name == section_of(key.name);
    })) << key.name;
    EXPECT_FALSE(key.meaning.empty()) << key.name;
  }
}

}  // namespace
}  // namespace spume::config
