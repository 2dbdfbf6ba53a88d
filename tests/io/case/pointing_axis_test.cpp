#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

Quantity angle_of(double degrees) {
  Quantity angle;
  angle.value = degrees * degree;
  return angle;
}

Case azimuth_case(double elevation) {
  Case stated = read_case(case_path("dss14-70m"));
  stated.axis = "azimuth";
  stated.antenna->elevation = angle_of(elevation);
  return stated;
}

Case x_axis_case(double y_angle) {
  Case stated = read_case(case_path("dss14-70m"));
  stated.axis = "X";
  stated.antenna->y_angle = angle_of(y_angle);
  return stated;
}

TEST(PointingAxis, FactorIsTheCosineOfTheElevationOfAnAzimuthAxis) {
  EXPECT_NEAR(pointing_axis(azimuth_case(60.0)).boresight_factor, 0.5, 1e-15);
  EXPECT_NEAR(pointing_axis(azimuth_case(120.0)).boresight_factor, 0.5, 1e-15);
  EXPECT_NEAR(antenna_of(azimuth_case(80.0)).boresight_factor, std::cos(80.0 * degree), 1e-15);
  Case stated = azimuth_case(60.0);
  stated.antenna->elevation.reset();
  EXPECT_EQ(pointing_axis(stated).boresight_factor, 1.0);
  EXPECT_FALSE(pointing_axis(stated).elevation);
  Case elevation = azimuth_case(60.0);
  elevation.axis = "elevation";
  EXPECT_EQ(pointing_axis(elevation).boresight_factor, 1.0);
}

TEST(PointingAxis, FactorIsTheCosineOfTheYAngleOfAnXAxis) {
  EXPECT_EQ(pointing_axis(x_axis_case(0.0)).boresight_factor, 1.0);
  EXPECT_NEAR(pointing_axis(x_axis_case(-60.0)).boresight_factor, 0.5, 1e-15);
  EXPECT_NEAR(antenna_of(x_axis_case(80.0)).boresight_factor, std::cos(80.0 * degree), 1e-15);
  Case stated = x_axis_case(60.0);
  stated.antenna->y_angle.reset();
  EXPECT_EQ(pointing_axis(stated).boresight_factor, 1.0);
  stated.axis = "Y";
  stated.antenna->elevation = angle_of(60.0);
  EXPECT_EQ(pointing_axis(stated).boresight_factor, 1.0);
}

// The loops act on the axis: only the boresight error depends on the attitude.
TEST(PointingAxis, RmsAtTheSkyFallsByTheCosineWithTheSameGains) {
  const control::Controller controller{control::LoopStructure::pi_with_lag(),
                                       {0.1587, 0.42067, 2.6279, 10.258, 0.23531}};
  const auto of = [&](const Case& stated) {
    const design::Mission mission = mission_of(stated);
    return design::assess(design::tracking_problem(mission), controller,
                          design::constraints(mission));
  };
  for (Case (*const make)(double) : {&azimuth_case, &x_axis_case}) {
    const design::Design full = of(make(0.0));
    ASSERT_GT(full.boresight_rms, 0.0);
    for (const double angle : {60.0, 80.0}) {
      const Case stated = make(angle);
      const design::Design found = of(stated);
      const double factor = std::cos(angle * degree);
      EXPECT_NEAR(found.boresight_rms / full.boresight_rms, factor, 1e-9 * factor)
          << stated.axis << angle;
      EXPECT_NEAR(found.noise_rms / full.noise_rms, factor, 1e-9 * factor) << stated.axis << angle;
      EXPECT_EQ(found.control_effort, full.control_effort) << stated.axis << angle;
      for (std::size_t b = 0; b < found.verification.peaks.size(); ++b) {
        EXPECT_EQ(found.verification.peaks[b].upper, full.verification.peaks[b].upper);
      }
    }
  }
}

EditedCase edited(const std::string& axis, const std::string& line) {
  EditedCase text;
  text.replace("\naxis = \"elevation\"\n", "\naxis = \"" + axis + "\"\n");
  text.replace("\n[antenna]\n", "\n[antenna]\n" + line);
  return text;
}

TEST(PointingAxis, RefusesAnAngleThatTheAxisDoesNotHave) {
  EXPECT_EQ(refusal_of(edited("X", "y_angle = \"30 deg\"\n").text()), "taken");
  EXPECT_EQ(refusal_of(edited("X", "").text()), "taken");
  for (const std::string axis : {"elevation", "azimuth", "Y"}) {
    const EditedCase text = edited(axis, "y_angle = ^\"30 deg\"\n");
    EXPECT_EQ(
        refusal_of(text.text()),
        fmt::format("case.toml:{}:{}: antenna.y_angle: expected it with axis = 'X', of an X-Y "
                    "mount, only, found it with '{}'",
                    text.line(), text.column(), axis));
  }
  EXPECT_THAT(refusal_of(edited("X", "y_angle = \"88 deg\"\n").text()),
              HasSubstr("antenna.y_angle: expected one at which the X axis moves"));
  EXPECT_THAT(refusal_of(edited("azimuth", "elevation = \"88 deg\"\n").text()),
              HasSubstr("antenna.elevation: expected one at which an azimuth axis moves"));
  EXPECT_EQ(refusal_of(edited("elevation", "elevation = \"88 deg\"\n").text()), "taken");
}

}  // namespace
}  // namespace boresight::io
