#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/synthetic_drive.hpp"
#include "refused_call.hpp"
#include <boresight/identification/grey_box/grey_box_record.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double sample_time = 0.005;

// A wave of 1 Hz in every channel, 20 s at 200 samples a second.
DriveRecord waves() {
  DriveRecord r;
  r.name = "waves";
  r.sample_time = sample_time;
  Eigen::VectorXd wave(4000);
  for (Index k = 0; k < wave.size(); ++k) {
    wave(k) = std::sin(2.0 * std::numbers::pi * sample_time * static_cast<double>(k));
  }
  const Eigen::VectorXd level = Eigen::VectorXd::Constant(4000, 8e6);
  r.inlet_pressure = {{level + 1e6 * wave, {}}, {level + 1e6 * wave, {}}};
  r.outlet_pressure = {{level - 1e6 * wave, {}}, {level - 1e6 * wave, {}}};
  r.motor_rate = {10.0 * wave, {}};
  r.valve_command = Signal{12.0 * wave, {}};
  return r;
}

Campaign with(const DriveRecord& record) {
  return {synthetic::knowledge(), synthetic::instruments(), {record}};
}

TEST(PrepareRecords, ThinsWithoutTouchingTheDrivesBand) {
  const auto records = prepare_records(with(waves()), {50.0, 1.0});
  ASSERT_EQ(records.size(), 1u);
  const auto& r = records[0];
  EXPECT_DOUBLE_EQ(r.sample_time, 0.02);
  ASSERT_EQ(r.samples(), 1000);
  const double torque = 4.0 * 1e6 * torque_per_pressure(synthetic::knowledge());
  for (Index k = 50; k < 950; ++k) {
    const double t = 0.02 * static_cast<double>(k);
    const double wave = std::sin(2.0 * std::numbers::pi * t);
    EXPECT_NEAR(r.rate(k), 10.0 * wave, 2e-2) << k;
    EXPECT_NEAR(r.side_1(k) - r.side_2(k), torque * wave, 2e-3 * torque) << k;
    // What drives: the mean of neighbours is the wave's mean over the step.
    const double mean =
        (std::cos(2.0 * std::numbers::pi * t) - std::cos(2.0 * std::numbers::pi * (t + 0.02))) /
        (2.0 * std::numbers::pi * 0.02);
    EXPECT_NEAR(0.5 * (r.torque(k) + r.torque(k + 1)), torque * mean, 2e-3 * torque) << k;
    EXPECT_NEAR(r.motion_slope(k), 20.0 * std::numbers::pi * std::cos(2.0 * std::numbers::pi * t),
                0.3)
        << k;
  }
  EXPECT_TRUE(r.valve_calibrated);
  EXPECT_FALSE(r.rate_counts[49]);
  EXPECT_TRUE(r.rate_counts[51]);
}

TEST(PrepareRecords, TakesARateCommandForTheValvesOnlyWithTheLoopOpen) {
  DriveRecord r = waves();
  r.rate_command = r.valve_command;
  r.valve_command.reset();
  EXPECT_GT(prepare_records(with(r), {50.0, 1.0})[0].valve.size(), 0);
  EXPECT_FALSE(prepare_records(with(r), {50.0, 1.0})[0].valve_calibrated);
  r.rate_loop_closed = true;
  EXPECT_EQ(prepare_records(with(r), {50.0, 1.0})[0].valve.size(), 0);
  // A command that reads zero while the valve is driven past it.
  r.rate_loop_closed = false;
  r.rate_command->values.setConstant(0.003);
  EXPECT_EQ(prepare_records(with(r), {50.0, 1.0})[0].valve.size(), 0);
}

TEST(PrepareRecords, ADeadChannelIsStoodInForByTheOthers) {
  DriveRecord r = waves();
  const auto whole = prepare_records(with(r), {50.0, 1.0});
  r.inlet_pressure[1].values.setZero();
  r.inlet_pressure[1].valid.assign(4000, false);
  const auto rest = prepare_records(with(r), {50.0, 1.0});
  EXPECT_LT((rest[0].side_1 - whole[0].side_1).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_TRUE(rest[0].rate_counts[500]);
  r.inlet_pressure[0].valid.assign(4000, false);
  EXPECT_TRUE(prepare_records(with(r), {50.0, 1.0}).empty());
}

TEST(PrepareRecords, WhatIsNotValidDoesNotCountAndPredictionStartsAfresh) {
  DriveRecord r = waves();
  r.motor_rate.valid.assign(4000, true);
  for (std::size_t k = 2000; k < 2200; ++k) r.motor_rate.valid[k] = false;
  auto prepared = prepare_records(with(r), {50.0, 1.0})[0];
  EXPECT_FALSE(prepared.rate_counts[510]);
  EXPECT_FALSE(prepared.rate_known[510]);
  EXPECT_TRUE(prepared.rate_counts[560]);
  // The torque was there all the time: the rate is predicted on; pressures need the rate.
  EXPECT_EQ(std::count(prepared.rate_restarts.begin(), prepared.rate_restarts.end(), true), 1);
  EXPECT_EQ(std::count(prepared.pressure_restarts.begin(), prepared.pressure_restarts.end(), true),
            2);
  EXPECT_FALSE(prepared.pressure_counts[510]);
  r = waves();
  r.outlet_pressure[0].valid.assign(4000, true);
  for (std::size_t k = 2000; k < 2200; ++k) r.outlet_pressure[0].valid[k] = false;
  prepared = prepare_records(with(r), {50.0, 1.0})[0];
  EXPECT_EQ(std::count(prepared.rate_restarts.begin(), prepared.rate_restarts.end(), true), 2);
  EXPECT_FALSE(prepared.rate_counts[570]);  // settling again
}

TEST(PrepareRecords, RefusesWhatDoesNotFit) {
  DriveRecord r = waves();
  r.motor_rate.values(7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(reference::Call([&] { prepare_records(with(r)); }),
              ThrowsMessage<InvalidInput>(
                  HasSubstr("expected 4000 finite values in 'motor_rate' of record 'waves'")));
  r = waves();
  r.inlet_pressure[1].values.conservativeResize(3999);
  EXPECT_THAT(
      reference::Call([&] { prepare_records(with(r)); }),
      ThrowsMessage<InvalidInput>(HasSubstr("in 'pressure' of record 'waves', found 3999")));
  r = waves();
  r.sample_time = 0.0;
  EXPECT_THAT(reference::Call([&] { prepare_records(with(r)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a positive sample time")));
  EXPECT_THAT(reference::Call([&] {
                prepare_records(with(waves()), {0.0, 1.0});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a positive sample rate")));
}

}  // namespace
}  // namespace boresight::identification
