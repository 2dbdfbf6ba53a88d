#include <gtest/gtest.h>

#include <boresight/app/report/axis_wording.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

TEST(AxisWording, NamesTheElevationOfCrossElevationErrors) {
  EXPECT_EQ(words_of({"elevation", 45.0 * degree, 1.0}), "elevation axis");
  EXPECT_EQ(words_of({"azimuth", 60.0 * degree, 0.5}),
            "azimuth axis, cross-elevation error at 60 deg elevation");
  EXPECT_EQ(words_of({"azimuth", {}, 1.0}), "azimuth axis, cross-elevation error at the horizon");
}

TEST(AxisWording, NamesTheYAngleOfAnXAxis) {
  EXPECT_EQ(words_of({"X", {}, 0.5, 60.0 * degree}),
            "X axis of an X-Y mount at Y = 60 deg, boresight error = axis error x cos(Y)");
  EXPECT_EQ(words_of({"X", {}, 1.0, {}}),
            "X axis of an X-Y mount at Y = 0 deg, boresight error = axis error x cos(Y)");
  EXPECT_EQ(words_of({"Y", {}, 1.0, {}}), "Y axis of an X-Y mount");
}

TEST(AxisWording, OmitsTheAxisThatTheTitleNames) {
  const io::PointingAxis elevation{"elevation", {}, 1.0};
  EXPECT_EQ(words_beside("70-m antenna", elevation), "elevation axis");
  EXPECT_EQ(words_beside("70-m antenna, elevation axis, again", elevation), "");
  EXPECT_EQ(words_beside("34-m antenna, azimuth axis", {"azimuth", {}, 1.0}),
            "cross-elevation error at the horizon");
  const io::PointingAxis x{"X", {}, 1.0, {}};
  EXPECT_EQ(words_beside("13-m antenna, X axis", x), words_of(x));
}

}  // namespace
}  // namespace boresight::app
