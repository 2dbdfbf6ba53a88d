#include <gtest/gtest.h>

#include "design/simulation/tested_drive.hpp"
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

TEST(DriveTests, CommandsAreThoseOfThePaper) {
  const auto drive = reference::tested_drive();
  const auto fast = drive_tests(drive, DriveTestKind::fast_ramp).front();
  const double limit = 10.0 * drive.recorder.tachometer.scale;
  EXPECT_FALSE(fast.rate_loop_closed);
  EXPECT_NEAR(fast.command.maxCoeff(), 1.5 * limit, 1e-9);
  EXPECT_NEAR(fast.command.minCoeff(), -1.5 * limit, 1e-9);
  EXPECT_NEAR(fast.command.sum(), 0.0, 1e-6);
  for (const auto& name : simulated_test_names()) {
    const auto kind = drive_test_kind(name);
    if (!kind) continue;
    for (const auto& test : drive_tests(drive, *kind)) {
      EXPECT_EQ(test.kind, *kind);
      EXPECT_TRUE(test.name.starts_with(name)) << test.name;
      EXPECT_TRUE(test.command.allFinite()) << name;
      EXPECT_LE(test.command.cwiseAbs().maxCoeff(), drive.antenna.valve.stroke_limit) << name;
    }
  }
}

TEST(DriveTests, ConstantSpeedsDoubleUpToTheRecordersLimit) {
  const auto drive = reference::tested_drive();
  const auto tests = drive_tests(drive, DriveTestKind::constant_speed);
  ASSERT_EQ(tests.size(), 6U);
  double volts = 0.25;
  for (const auto& test : tests) {
    EXPECT_DOUBLE_EQ(test.tachometer_volts, volts);
    EXPECT_NEAR(test.command.maxCoeff(), volts * drive.recorder.tachometer.scale, 1e-12);
    EXPECT_TRUE(test.rate_loop_closed && test.held);
    volts *= 2.0;
  }
  EXPECT_EQ(tests.front().name, "constant-speed-0.25V");
  EXPECT_EQ(tests.back().name, "constant-speed-8V");
}

TEST(DriveTests, SloshIsSampledFastEnoughForTheLines) {
  auto drive = reference::tested_drive();
  EXPECT_EQ(drive_tests(drive, DriveTestKind::slosh).front().sample_time, 1e-3);
  EXPECT_EQ(drive_tests(drive, DriveTestKind::valve_steps).front().sample_time, 5e-3);
  drive.recorder.sample_rate = 4000.0;
  EXPECT_EQ(drive_tests(drive, DriveTestKind::slosh).front().sample_time, 2.5e-4);
}

TEST(DriveTests, AreThoseOfTheDrive) {
  EXPECT_EQ(simulated_test_names().size(), 8U);
  EXPECT_EQ(drive_test_kind("valve-chirp"), DriveTestKind::valve_chirp);
  for (const auto* other : {"tracking", "slew", "slosch", ""}) {
    EXPECT_FALSE(drive_test_kind(other)) << other;
  }
}

TEST(DriveTests, RefuseARecorderThatSetsNoAmplitude) {
  for (double plant::TachometerRecording::*number :
       {&plant::TachometerRecording::scale, &plant::TachometerRecording::limit}) {
    auto drive = reference::tested_drive();
    drive.recorder.tachometer.*number = 0.0;
    EXPECT_THROW(drive_tests(drive, DriveTestKind::slow_ramp), InvalidInput);
  }
  auto drive = reference::tested_drive();
  drive.recorder.sample_rate = 0.0;
  EXPECT_THROW(drive_tests(drive, DriveTestKind::slosh), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
