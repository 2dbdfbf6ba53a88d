#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <boresight/plant/nonlinear/nonlinear_drive.hpp>
#include <boresight/plant/nonlinear/run_events.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double interval = 0.01;

// A run in which nothing happens, to be written into.
SimulationResult quiet(const NonlinearAntenna& antenna, Index samples) {
  SimulationResult run;
  const auto system = to_feedback_system(antenna);
  run.names.assign(system.linear.outputs.begin() + system.channel_inputs,
                   system.linear.outputs.end());
  run.values = Eigen::MatrixXd::Zero(samples, static_cast<Index>(run.names.size()));
  for (std::size_t i = 0; i < run.names.size(); ++i) {
    if (run.names[i].find("pressure") != std::string::npos) {
      run.values.col(static_cast<Index>(i)).setConstant(5e6);
    }
  }
  return run;
}

auto written(SimulationResult& run, const std::string& name) {
  return run.values.col(std::ranges::find(run.names, name) - run.names.begin());
}

class RunEventsTest : public testing::Test {
 protected:
  NonlinearAntenna antenna = nonlinear_antenna(demo_antenna());
  SimulationResult run = quiet(antenna, 1000);
  RunEvents found() const { return events_of(antenna, run, VectorXd::Zero(1000), interval); }
};

TEST_F(RunEventsTest, OfRestAreNone) {
  const auto events = found();
  EXPECT_TRUE(events.sliding_starts.empty());
  EXPECT_FALSE(first_start(events, true));
  for (const auto* event : {&events.stroke_limit, &events.slew_limit, &events.command_limit,
                            &events.contact_lost, &events.below_makeup, &events.below_zero}) {
    EXPECT_EQ(event->samples, 0);
    EXPECT_FALSE(event->first);
    EXPECT_EQ(event->fraction, 0.0);
  }
  EXPECT_EQ(events.contact_losses, 0);
  EXPECT_DOUBLE_EQ(events.lowest_pressure.value_or(0.0), 5e6);
}

TEST_F(RunEventsTest, SlidingStartsWhereTheBristlesHaveBent) {
  // Rest, up at 0.1 rad/s from 2 s to 4 s, rest, down at 0.2 rad/s from 6 s on.
  double angle = 0.0;
  for (Index k = 0; k < 1000; ++k) {
    const double t = interval * static_cast<double>(k);
    const double rate = t >= 6.0 ? -0.2 : t >= 2.0 && t < 4.0 ? 0.1 : 0.0;
    written(run, "motor_rate")[k] = rate;
    written(run, "motor_angle")[k] = angle;
    written(run, "friction_torque")[k] = antenna.offset.constant + (rate < 0.0 ? -18.0 : 17.0);
    written(run, "motor_torque")[k] = rate < 0.0 ? -24.0 : 12.0;
    angle += rate * interval;
  }
  const auto events = found();
  ASSERT_EQ(events.sliding_starts.size(), 2U);
  const double bend = antenna.friction.curve.breakaway_torque / antenna.friction.bristle_stiffness;
  const auto up = first_start(events, true).value_or(SlidingStart{});
  EXPECT_TRUE(up.shows_breakaway);
  EXPECT_NEAR(up.time, 2.0 + 4.0 * bend / 0.1, 1.5 * interval);
  EXPECT_NEAR(up.rate, 0.1, 1e-12);
  EXPECT_NEAR(up.friction, 17.0, 1e-9);
  EXPECT_NEAR(up.motor_torque, 12.0, 1e-9);
  // Faster than the curve's Stribeck rate: sliding, but no breakaway to be read.
  EXPECT_FALSE(first_start(events, false));
  const SlidingStart& down = events.sliding_starts[1];
  EXPECT_FALSE(down.upward);
  EXPECT_FALSE(down.shows_breakaway);
  EXPECT_NEAR(down.time, 6.0 + 4.0 * bend / 0.2, 1.5 * interval);
  EXPECT_NEAR(down.friction, 18.0, 1e-9);
  EXPECT_NEAR(down.rate, 0.2, 1e-12);
}

TEST_F(RunEventsTest, BendingBristlesAndQuickReversalsAreNoStarts) {
  // A swing within the bristles' reach, then a reversal that does not stand still.
  const double bend = antenna.friction.curve.breakaway_torque / antenna.friction.bristle_stiffness;
  for (Index k = 0; k < 1000; ++k) {
    const double t = interval * static_cast<double>(k);
    const double swing = 2.0 * std::numbers::pi * 2.0;  // rad/s
    const bool bending = t >= 1.0 && t < 5.0;
    written(run, "motor_angle")[k] = bending ? bend * std::sin(swing * t) : 0.0;
    written(run, "motor_rate")[k] = bending ? bend * swing * std::cos(swing * t) : 0.0;
  }
  EXPECT_GT(written(run, "motor_rate").maxCoeff(), 0.1 * antenna.friction.curve.stribeck_rate);
  EXPECT_TRUE(found().sliding_starts.empty());
  for (Index k = 0; k < 1000; ++k) {
    written(run, "motor_rate")[k] = k < 500 ? 1.0 : -1.0;
    written(run, "motor_angle")[k] = interval * static_cast<double>(k < 500 ? k : 1000 - k);
  }
  EXPECT_TRUE(found().sliding_starts.empty());
}

TEST_F(RunEventsTest, LimitsAreCountedFromTheirFirstSample) {
  written(run, "spool").segment(300, 50).setConstant(-1.001 * antenna.valve.stroke_limit);
  const double lost = antenna.gear.preload_torque / (0.5 * antenna.gear.stiffness);
  written(run, "motor_angle").segment(100, 10).setConstant(1.01 * lost);
  written(run, "encoder").segment(200, 10).setConstant(1.01 * lost);
  written(run, "encoder").segment(400, 10).setConstant(0.99 * lost);
  written(run, "outlet_pressure_3").segment(700, 20).setConstant(1e4);
  written(run, "inlet_pressure_2").segment(900, 5).setConstant(-1e4);
  VectorXd commands = VectorXd::Zero(1000);
  commands.tail(250).setConstant(antenna.valve.stroke_limit);
  const auto events = events_of(antenna, run, commands, interval);
  EXPECT_EQ(events.stroke_limit.samples, 50);
  EXPECT_NEAR(events.stroke_limit.first.value_or(0.0), 3.0, 1e-9);
  EXPECT_DOUBLE_EQ(events.stroke_limit.fraction, 0.05);
  EXPECT_EQ(events.slew_limit.samples, 2);  // the jumps there and back
  EXPECT_EQ(events.command_limit.samples, 250);
  EXPECT_EQ(events.contact_losses, 2);
  EXPECT_EQ(events.contact_lost.samples, 20);
  EXPECT_NEAR(events.contact_lost.first.value_or(0.0), 1.0, 1e-9);
  EXPECT_EQ(events.below_makeup.samples, 25);
  EXPECT_EQ(events.below_zero.samples, 5);
  EXPECT_NEAR(events.below_zero.first.value_or(0.0), 9.0, 1e-9);
  EXPECT_DOUBLE_EQ(events.lowest_pressure.value_or(0.0), -1e4);
}

}  // namespace
}  // namespace boresight::plant
