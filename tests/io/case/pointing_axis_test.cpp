#include <cmath>
#include <numbers>
#include <string>

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

Case azimuth_case(double elevation) {
  Case stated = read_case(case_path("dss14-70m"));
  stated.axis = "azimuth";
  stated.antenna->elevation = Quantity{};
  stated.antenna->elevation->value = elevation * degree;
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

// The loops act on the axis: only what their error is worth at the sky depends on the elevation.
TEST(PointingAxis, RmsAtTheSkyFallsByTheCosineWithTheSameGains) {
  const control::ControlLaw law{control::LoopStructure::pi_with_lag(),
                                {0.1587, 0.42067, 2.6279, 10.258, 0.23531}};
  const auto at = [&](double elevation) {
    const design::Mission mission = mission_of(azimuth_case(elevation));
    return design::assess(design::tracking_problem(mission), law, design::constraints(mission));
  };
  const design::Design horizon = at(0.0);
  ASSERT_GT(horizon.beam_rms, 0.0);
  for (const double elevation : {60.0, 80.0}) {
    const design::Design found = at(elevation);
    const double factor = std::cos(elevation * degree);
    EXPECT_NEAR(found.beam_rms / horizon.beam_rms, factor, 1e-9 * factor) << elevation;
    EXPECT_NEAR(found.noise_rms / horizon.noise_rms, factor, 1e-9 * factor) << elevation;
    EXPECT_EQ(found.valve_effort, horizon.valve_effort) << elevation;
    for (std::size_t b = 0; b < found.verification.peaks.size(); ++b) {
      EXPECT_EQ(found.verification.peaks[b].upper, horizon.verification.peaks[b].upper);
    }
  }
}

}  // namespace
}  // namespace boresight::io
