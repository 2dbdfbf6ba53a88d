#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_nonlinear_antenna.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/feedback_interconnection.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

// Where simulations stall, stick or blow up: each must end, with finite numbers or an error that
// says why.
namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The valve opened to either side and closed again.
SimulationResult exercise(const NonlinearAntenna& antenna, double duration, double interval,
                          double opening) {
  SimulationPlan plan;
  plan.interval = interval;
  plan.state = state_at_rest(antenna);
  plan.signals = {"valve_command"};
  const auto samples = static_cast<Index>(std::llround(duration / interval)) + 1;
  plan.values = MatrixXd::Zero(samples, 1);
  for (Index k = 0; k < samples; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(samples);
    plan.values(k, 0) = part < 0.1 || part > 0.7 ? 0.0 : part < 0.4 ? opening : -opening;
  }
  plan.held = {true};
  return simulate(to_feedback_system(antenna), plan);
}

TEST(SimulationCorners, BristlesAHundredTimesAsStiff) {
  auto details = reference::drive_details();
  details.friction.bristle_stiffness *= 100.0;
  const auto stiff = exercise(reference::nonlinear_antenna(details), 4.0, 0.01, 8.0);
  const auto soft = exercise(reference::nonlinear_antenna(), 4.0, 0.01, 8.0);
  ASSERT_TRUE(stiff.values.allFinite());
  // The steady curve is the same, so that the motion differs little once it slides.
  EXPECT_NEAR(column(stiff, "motor_rate").maxCoeff(), column(soft, "motor_rate").maxCoeff(), 0.5);
}

TEST(SimulationCorners, WideOverlap) {
  auto details = reference::drive_details();
  details.overlap = 0.2 * details.stroke_limit;
  const auto antenna = reference::nonlinear_antenna(details);
  // Within the overlap nothing moves, beyond it the rest of the opening counts.
  EXPECT_LT(column(exercise(antenna, 4.0, 0.01, 25.0), "motor_rate").cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_GT(column(exercise(antenna, 4.0, 0.01, 40.0), "motor_rate").maxCoeff(), 3.0);
}

TEST(SimulationCorners, WithoutLeakage) {
  auto linear = reference::antenna();
  linear.drive.leakage_rate = 0.0;
  const auto antenna =
      make_nonlinear_antenna(linear, reference::hydraulic_drive(), reference::drive_details());
  const auto run = exercise(antenna, 4.0, 0.01, 8.0);
  ASSERT_TRUE(run.values.allFinite());
  EXPECT_GT(column(run, "motor_rate").maxCoeff(), 5.0);
}

TEST(SimulationCorners, SupplyAllButOff) {
  auto details = reference::drive_details();
  details.supply_pressure = 1e4;  // 0.2 N m at the motor: far from breaking away
  const auto run = exercise(reference::nonlinear_antenna(details), 4.0, 0.01, 100.0);
  ASSERT_TRUE(run.values.allFinite());
  EXPECT_LT(column(run, "motor_rate").cwiseAbs().maxCoeff(), 2e-2);
}

TEST(SimulationCorners, AnHourAtRest) {
  const auto antenna = reference::nonlinear_antenna();
  const auto run = exercise(antenna, 3600.0, 0.1, 0.0);
  EXPECT_EQ(run.values.rows(), 36001);
  EXPECT_LT(column(run, "motor_angle").cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT(run.statistics.steps, 50000);
}

TEST(SimulationCorners, NotANumberIsRefused) {
  SimulationPlan plan;
  plan.interval = 0.01;
  plan.signals = {"valve_command"};
  plan.values = MatrixXd::Zero(11, 1);
  plan.values(5, 0) = std::nan("");
  EXPECT_THROW(simulate(to_feedback_system(reference::nonlinear_antenna()), plan), InvalidInput);
  plan.values(5, 0) = 0.0;
  plan.state =
      VectorXd::Constant(state_at_rest(reference::nonlinear_antenna()).size(), std::nan(""));
  EXPECT_THROW(simulate(to_feedback_system(reference::nonlinear_antenna()), plan), InvalidInput);
}

// An antenna nobody built, but which could be.
NonlinearAntenna random_nonlinear_antenna(reference::RandomNumbers& random) {
  auto drive = reference::hydraulic_drive();
  drive.volume_1 *= random.log_uniform(0.3, 3.0);
  drive.volume_2 *= random.log_uniform(0.3, 3.0);
  auto details = reference::drive_details();
  details.supply_pressure *= random.log_uniform(0.2, 3.0);
  details.return_pressure = details.supply_pressure * random.uniform(0.0, 0.3);
  details.supply_droop = random.uniform(0.0, 1.0) * details.supply_pressure / 300.0;
  details.null_leakage_share = random.uniform(0.0, 0.5);
  details.case_leakage_share = random.uniform(0.0, 0.5);
  details.stroke_limit = random.log_uniform(10.0, 300.0);
  details.slew_limit = random.log_uniform(50.0, 1e4);
  details.overlap = random.uniform(0.0, 0.1) * details.stroke_limit;
  details.null_offset = random.uniform(-0.02, 0.02) * details.stroke_limit;
  details.laminar_pressure = random.log_uniform(1e2, 1e5);
  details.makeup_pressure = random.uniform(0.0, 3e5);
  details.air_fraction = random.integer(0, 1) == 0 ? 0.0 : random.log_uniform(1e-4, 3e-2);
  details.line_lengths.resize(static_cast<std::size_t>(random.integer(0, 2)));
  for (auto& length : details.line_lengths) length *= random.log_uniform(0.3, 3.0);
  details.line_damping_ratio = random.log_uniform(1e-3, 0.3);
  details.modes_per_line = random.integer(0, 2);
  auto& friction = details.friction;
  friction.curve.coulomb_torque *= random.log_uniform(0.1, 5.0);
  friction.curve.breakaway_torque = friction.curve.coulomb_torque * random.log_uniform(1.0, 2.5);
  friction.curve.stribeck_rate *= random.log_uniform(0.1, 10.0);
  friction.curve.saturating_torque *= random.log_uniform(0.01, 2.0);
  friction.curve.saturating_rate *= random.log_uniform(0.1, 10.0);
  friction.curve.viscous_friction *= random.log_uniform(0.05, 5.0);
  friction.bristle_stiffness *= random.log_uniform(0.05, 50.0);
  friction.bristle_damping *= random.log_uniform(0.05, 5.0);
  if (random.integer(0, 3) == 0) friction.bristle_stiffness = 0.0;
  friction.smoothing_rate = random.log_uniform(1e-3, 0.1);
  details.offset.constant = random.uniform(-20.0, 20.0);
  details.offset.cosine = random.uniform(-20.0, 20.0);
  if (random.integer(0, 1) == 0) {
    details.preload_torque = random.log_uniform(1.0, 50.0);
    details.backlash = random.log_uniform(1e-3, 1.0);
  }
  return make_nonlinear_antenna(reference::random_antenna(random), drive, details);
}

// Ten thousand antennas in eight parts, which run side by side.
class RandomAntennas : public testing::TestWithParam<int> {};

TEST_P(RandomAntennas, EndInNumbersOrAReport) {
  reference::RandomNumbers random(static_cast<std::uint64_t>(410 + GetParam()));
  int failures = 0;
  for (int trial = 0; trial < 1250; ++trial) {
    const auto antenna = random_nonlinear_antenna(random);
    const double opening = random.uniform(-1.3, 1.3) * antenna.valve.stroke_limit;
    try {
      const auto run = exercise(antenna, 0.3, 0.02, opening);
      ASSERT_TRUE(run.values.allFinite()) << trial;
    } catch (const NumericalFailure& error) {
      ++failures;
      EXPECT_THAT(error.what(), testing::HasSubstr(" s")) << trial;  // says when
    }
  }
  EXPECT_EQ(failures, 0);
}

INSTANTIATE_TEST_SUITE_P(Parts, RandomAntennas, testing::Range(0, 8));

}  // namespace
}  // namespace boresight::plant
