#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/tested_drive_of.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

Case reference() {
  return read_case(case_path("dss14-70m"));
}

TEST(TestedDriveOf, SpreadsTheLinesOverTheMotors) {
  const auto model = make_nonlinear_antenna(reference());
  ASSERT_EQ(model.oil.lines.size(), 4U);
  EXPECT_DOUBLE_EQ(model.oil.lines.front().length, 13.11);
  EXPECT_DOUBLE_EQ(model.oil.lines.back().length, 15.60);
  EXPECT_NEAR(model.oil.lines[1].length, 13.94, 1e-9);
  // 2000 psi on four motors.
  EXPECT_NEAR(model.oil.supply_torque, 315.7, 0.1);
  EXPECT_NEAR(recorder_of(reference()).tachometer.scale, 2.2621, 1e-4);
}

TEST(TestedDriveOf, ScalesATachometerOnAnyShaft) {
  Case antenna = reference();
  ASSERT_TRUE(antenna.campaign->tachometer);
  RecordedTachometerEntry& tachometer = *antenna.campaign->tachometer;
  const double volts = 20.0 * std::numbers::pi / 157.0;  // rad/s of the shaft, a volt
  tachometer.motor_teeth.reset();
  tachometer.tachometer_teeth.reset();
  tachometer.shaft = "motor";
  EXPECT_NEAR(recorder_of(antenna).tachometer.scale, volts, 1e-12);
  EXPECT_NO_THROW(tested_drive_of(antenna));
  tachometer.shaft = "antenna";
  EXPECT_NEAR(recorder_of(antenna).tachometer.scale / volts, 28723.647, 1e-3);
}

TEST(TestedDriveOf, TakesTheCasesNumbers) {
  const Case stated = reference();
  const auto drive = tested_drive_of(stated);
  EXPECT_NEAR(drive.slew_rate, 0.25 * std::numbers::pi / 180.0 * gear_ratio(stated), 1e-9);
  EXPECT_EQ(drive.rate_loop.gain, 1.0);
  EXPECT_EQ(drive.rate_loop.corner, 0.3);
  EXPECT_EQ(drive.recorder.sample_rate, 200.0);
  EXPECT_EQ(drive.recorder.low_pass.order, 0);
  EXPECT_NEAR(drive.recorder.pressure.gain_error, 0.007, 1e-12);
  EXPECT_NEAR(drive.recorder.pressure.range, 3000.0 * 6894.757, 10.0);
  EXPECT_NEAR(drive.recorder.tachometer.noise, 8e-3, 1e-12);
  EXPECT_EQ(drive.recorder.tachometer.limit, 10.0);
}

TEST(TestedDriveOf, NamesWhatARecordNeedsBeforeAnythingRuns) {
  const auto refusal = [](const auto& change) -> std::string {
    Case antenna = reference();
    change(antenna);
    EXPECT_NO_THROW(make_nonlinear_antenna(antenna));  // of tracking and slew
    try {
      tested_drive_of(antenna);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal([](Case& antenna) { antenna.campaign->lines.clear(); }),
              HasSubstr("expected an [[oil.line]] with its length"));
  EXPECT_THAT(refusal([](Case& antenna) { antenna.recorder.reset(); }),
              HasSubstr("expected a table [recorder]"));
  EXPECT_THAT(refusal([](Case& antenna) { antenna.campaign->tachometer.reset(); }),
              HasSubstr("expected a table [tachometer]"));
  EXPECT_THAT(refusal([](Case& antenna) { antenna.campaign->tachometer->voltage.reset(); }),
              HasSubstr("expected tachometer.voltage"));
  EXPECT_THAT(refusal([](Case& antenna) { antenna.campaign->tachometer->recorder_limit.reset(); }),
              HasSubstr("expected tachometer.recorder_limit"));
  Case linear = reference();
  linear.simulation.reset();
  EXPECT_THROW(require_simulation(linear), InvalidInput);
  EXPECT_THROW(tested_drive_of(linear), InvalidInput);
}

}  // namespace
}  // namespace boresight::io
