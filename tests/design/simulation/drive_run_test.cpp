#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/simulation/tested_drive.hpp"
#include <boresight/design/simulation/drive_run.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using testing::SizeIs;

// The first so many seconds of a test.
DriveTest beginning(const TestedDrive& drive, DriveTestKind kind, double duration) {
  auto test = drive_tests(drive, kind).front();
  test.command.conservativeResize(static_cast<Index>(duration / test.sample_time));
  return test;
}

TEST(DriveRun, FastRampLeavesTheRecordersRange) {
  const auto drive = reference::tested_drive();
  const auto run = run_drive_test(drive, beginning(drive, DriveTestKind::fast_ramp, 20.0), 1, {});
  ASSERT_THAT(run.channels, SizeIs(12));
  EXPECT_EQ(run.channels[9].name, "tach");
  EXPECT_GT(run.at_limit, 0.02);
  ASSERT_THAT(run.clipped, SizeIs(1));
  EXPECT_EQ(run.clipped.front().name, "tach");
  EXPECT_NEAR(run.channels[9].values.maxCoeff(), 10.0, 5e-3);
  EXPECT_NEAR(run.channels[9].values.minCoeff(), -10.0, 5e-3);
  EXPECT_GT(run.largest_rate, 10.0 * drive.recorder.tachometer.scale);
  EXPECT_GT(run.largest_torque, 69.49);  // the friction at speed
  EXPECT_LT(run.largest_torque, 316.0);
  for (std::size_t i = 1; i < 9; ++i) {
    EXPECT_GT(run.channels[i].values.minCoeff(), 0.0) << run.channels[i].name;
    EXPECT_LT(run.channels[i].values.maxCoeff(), 2000 * 6894.757e-6) << run.channels[i].name;
  }
}

TEST(DriveRun, SlowMotionBreaksAwayAtTheStaticFriction) {
  const auto drive = reference::tested_drive();
  // The first quarter of a period: at rest, breakaway, sliding upwards.
  const auto run = run_drive_test(drive, beginning(drive, DriveTestKind::slow_ramp, 12.0), 1, {});
  // Between the Coulomb level and the breakaway's with what bends the bristles faster.
  EXPECT_GT(run.static_friction, 10.33);
  EXPECT_LT(run.static_friction, 1.2 * 16.83);
  EXPECT_EQ(run.curve_breakaway, 16.83);
  EXPECT_GT(run.largest_rate, 0.2);
}

TEST(DriveRun, EndsWhereItIsToldAndSaysSo) {
  const auto drive = reference::tested_drive();
  const auto test = drive_tests(drive, DriveTestKind::slosh).front();
  const auto run = run_drive_test(drive, test, 1, [](double done) { return done < 0.3; });
  EXPECT_FALSE(run.complete);
  EXPECT_DOUBLE_EQ(run.planned_duration, 10.0);
  const auto samples = run.channels.front().values.size();
  EXPECT_NEAR(run.duration, 1e-3 * static_cast<double>(samples - 1), 1e-9);
  EXPECT_LT(samples, test.command.size());
  EXPECT_GT(samples, test.command.size() / 4);
}

double mean_of(const DriveTestRecord& record, std::size_t channel) {
  return record.channels[channel].values.mean();
}

TEST(DriveRun, GainsAreTheSeedsAndNoiseThatOfTheTest) {
  const auto drive = reference::tested_drive();
  auto test = beginning(drive, DriveTestKind::slosh, 0.2);  // at rest
  const auto run = run_drive_test(drive, test, 1, {});
  EXPECT_EQ(run_drive_test(drive, test, 1, {}).channels[1].values, run.channels[1].values);
  const auto other_seed = run_drive_test(drive, test, 2, {});
  test.name = "another";
  const auto other_test = run_drive_test(drive, test, 1, {});
  double moved = 0.0;  // MPa
  for (std::size_t port = 1; port < 9; ++port) {
    EXPECT_NE(other_test.channels[port].values, run.channels[port].values);
    // 0.0055 MPa of noise a sample, 200 of them.
    EXPECT_NEAR(mean_of(other_test, port), mean_of(run, port), 0.005);
    moved += std::abs(mean_of(other_seed, port) - mean_of(run, port));
  }
  EXPECT_GT(moved, 0.05);
}

TEST(DriveRun, LowPassLeavesTheRecordersRateAsItIs) {
  auto drive = reference::tested_drive();
  const auto test = beginning(drive, DriveTestKind::slosh, 0.5);
  const auto bare = run_drive_test(drive, test, 1, {});
  drive.recorder.low_pass = {2, 100.0};
  const auto filtered = run_drive_test(drive, test, 1, {});
  EXPECT_EQ(filtered.sample_time, bare.sample_time);
  for (std::size_t channel = 0; channel < filtered.channels.size(); ++channel) {
    EXPECT_EQ(filtered.channels[channel].values.size(), test.command.size());
  }
}

TEST(DriveRun, NeedsLinesAndACommand) {
  auto drive = reference::tested_drive();
  auto test = beginning(drive, DriveTestKind::slosh, 0.1);
  test.command.resize(0);
  EXPECT_THROW(run_drive_test(drive, test, 1, {}), InvalidInput);
  drive.antenna.oil.lines.clear();
  EXPECT_THROW(run_drive_test(drive, beginning(drive, DriveTestKind::slosh, 0.1), 1, {}),
               InvalidInput);
}

}  // namespace
}  // namespace boresight::design
