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

}  // namespace
}  // namespace boresight::app
