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

}  // namespace
}  // namespace boresight::app
