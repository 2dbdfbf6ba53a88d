#include <gtest/gtest.h>

#include <boresight/app/commands/progress_line.hpp>

namespace boresight::app {
namespace {

TEST(DurationText, IsAsExactAsAForecast) {
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(89.6), "90 s");
  EXPECT_EQ(duration_text(120.0), "2 min");
  EXPECT_EQ(duration_text(6000.0), "100 min");
  EXPECT_EQ(duration_text(12600.0), "3.5 h");
}

}  // namespace
}  // namespace boresight::app
