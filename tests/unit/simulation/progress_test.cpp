#include "spume/simulation/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spume::simulation {
namespace {

using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

const ProgressState state{"drain", 12.5, 0.25, "max_step", 7, 3, 0.5};

TEST(ProgressLine, SaysStageTimeStepAndWhatLimitsIt) {
  CaptureStderr();
  { ProgressLine(true).show(state); }
  const std::string text = GetCapturedStderr();
  for (const char* part : {"drain", "t = 12.5", "dt = 2.50e-01 s (max_step)", "bubbles 7", "ruptures 3"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  EXPECT_EQ(text.front(), '\r');
  EXPECT_EQ(text.back(), '\n');  // the destructor ends the line
}

TEST(ProgressLine, IsRewrittenAtMostFiveTimesASecond) {
  CaptureStderr();
  ProgressLine line(true);
  for (int n = 0; n < 1000; ++n) line.show(state);
  const std::string text = GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 1);
}

TEST(ProgressLine, AnnouncementsStandAboveTheLiveLine) {
  CaptureStderr();
  {
    ProgressLine line(true);
    line.show(state);
    line.announce("rupture");
    line.show(state);
  }
  const std::string text = GetCapturedStderr();
  const auto announced = text.find("\rrupture");
  ASSERT_NE(announced, std::string::npos);
  const auto end = text.find('\n', announced);
  // It covers all of the live line that it overwrites, and the live line comes again below.
  EXPECT_GE(end - announced, announced);
  EXPECT_NE(text.find("drain", end), std::string::npos);
}

TEST(ProgressLine, WritesNothingWhenItIsOff) {
  CaptureStderr();
  {
    ProgressLine line(false);
    line.show(state);
    line.announce("rupture");
  }
  EXPECT_EQ(GetCapturedStderr(), "");
}

}  // namespace
}  // namespace spume::simulation
