#include "spume/verification/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "spume/base/error.hpp"
#include "spume/verification/study.hpp"

namespace spume::verification {
namespace {

TEST(Report, counts_what_is_outside_its_band) {
  testing::internal::CaptureStdout();
  Report report(parallel::Communicator::world());
  report.relative("inside", 1.009, 1, 0.01, "");
  report.relative("outside", 0.98, 1, 0.01, "");
  report.absolute("inside", -0.2, 0, 0.3, "");
  report.absolute("outside", -0.4, 0, 0.3, "");
  report.at_most("inside", 1, 1, "");
  report.at_most("outside", 1.1, 1, "");
  report.at_least("outside", 0.9, 1, "");
  report.told("not judged", 1e9, "", 0.0);
  const std::string text = testing::internal::GetCapturedStdout();
  EXPECT_EQ(report.n_judged(), 7);
  EXPECT_EQ(report.n_outside(), 4);
  std::size_t n_wrong = 0;
  for (std::size_t at = text.find("WRONG"); at != std::string::npos; at = text.find("WRONG", at + 1))
    ++n_wrong;
  EXPECT_EQ(n_wrong, 4u);
}

TEST(Report, takes_no_lost_number_for_a_good_one) {
  testing::internal::CaptureStdout();
  Report report(parallel::Communicator::world());
  report.relative("lost", std::nan(""), 1, 0.01, "");
  report.at_most("lost", std::nan(""), 1, "");
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(report.n_outside(), 2);
}

TEST(Study, that_fails_numerically_is_told_as_outside) {
  testing::internal::CaptureStdout();
  Report report(parallel::Communicator::world());
  const Study broken{
      "broken", "",
      "",       1,
      1,        [](const parallel::Communicator&, Scale, Report&) {
                       throw NumericalError("not finite"); }};
  run(broken, parallel::Communicator::world(), Scale::Full, report);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("not finite"), std::string::npos);
  EXPECT_EQ(report.n_outside(), 1);
}

TEST(Studies, have_names_of_their_own_and_the_quicker_come_first) {
  std::set<std::string> names;
  for (const Study& study : studies()) {
    EXPECT_TRUE(names.insert(study.name).second) << study.name;
    EXPECT_FALSE(study.summary.empty());
    EXPECT_FALSE(study.source.empty());
    EXPECT_LE(study.small_seconds, study.seconds);
  }
  EXPECT_TRUE(std::ranges::is_sorted(studies(), {}, &Study::seconds));
}

}  // namespace
}  // namespace spume::verification
