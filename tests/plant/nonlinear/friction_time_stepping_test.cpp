#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/time_response.hpp>
#include <boresight/plant/nonlinear/friction_time_stepping.hpp>

namespace boresight::plant {
namespace {

constexpr double step = 0.0025;

FrictionAntenna antenna() {
  FrictionAntenna one;
  one.linear.drive = {90.0, 0.4, 2.0, 1.4, 75.0, 0.7, 200.0};
  one.linear.structure = {1.0, 900.0, 4.0, 0.5, 0.6, {{0.6, 900.0, 0.5, 0.5, 0.4}}};
  one.friction.curve = {10.0, 17.0, 0.15, 60.0, 1.5, 2.0};
  one.friction.bristle_stiffness = 2500.0;
  one.friction.bristle_damping = 5.0;
  return one;
}

void run(FrictionTimeStepping& stepping, double command, double duration) {
  for (double t = 0.0; t < duration; t += step) stepping.advance(command);
}

TEST(FrictionTimeStepping, IsTheLinearAntennaWithHardlyAnyFriction) {
  FrictionAntenna slippery = antenna();
  slippery.friction.curve = {1e-9, 1e-9, 1.0, 0.0, 1.0, 0.0};
  FrictionTimeStepping stepping(slippery, step);
  StateSpace linear = to_state_space(slippery.linear);
  constexpr Eigen::Index samples = 800;
  Eigen::MatrixXd inputs = Eigen::MatrixXd::Zero(samples, 2);
  for (Eigen::Index k = 0; k < samples; ++k) inputs(k, 0) = std::sin(0.01 * static_cast<double>(k));
  const Eigen::MatrixXd expected = LinearSimulation(linear, step).simulate(inputs);
  for (Eigen::Index k = 0; k < samples; ++k) {
    EXPECT_NEAR(stepping.tachometer(), expected(k, 0), 1e-7);
    EXPECT_NEAR(stepping.motor_torque(), expected(k, 1), 1e-7);
    EXPECT_NEAR(stepping.encoder(), expected(k, 2), 1e-7);
    EXPECT_NEAR(stepping.boresight(), expected(k, 3), 1e-7);
    stepping.advance(inputs(k, 0));
  }
}

TEST(FrictionTimeStepping, CreepsByItsBristlesBelowBreakaway) {
  for (const double offset : {0.0, -5.0}) {
    FrictionAntenna held = antenna();
    held.offset_torque = offset;
    FrictionTimeStepping stepping(held, step);
    EXPECT_EQ(stepping.motor_torque(), offset);
    // Leakage takes the whole flow: T = K x/lambda.
    constexpr double torque = 8.0;
    run(stepping, torque * held.linear.drive.leakage_rate / held.linear.drive.oil_stiffness, 60.0);
    EXPECT_NEAR(stepping.motor_torque(), torque, 1e-6 * torque);
    EXPECT_NEAR(stepping.motor_rate(), 0.0, 1e-8);
    // z' = w (1 - sigma z/g) with the breakaway torque g: the motor creeps by more than the bend.
    const double breakaway = held.friction.curve.breakaway_torque;
    const double creep = -breakaway / held.friction.bristle_stiffness *
                         std::log(1.0 - (torque - offset) / breakaway);
    EXPECT_NEAR(stepping.encoder(), creep, 5e-3 * creep);
  }
}

TEST(FrictionTimeStepping, StandsStillUnderItsHoldingCommand) {
  FrictionAntenna held = antenna();
  held.offset_torque = 9.0;
  held.supply_torque = 300.0;
  FrictionTimeStepping stepping(held, step);
  // Flow of an opening: x sqrt(1 - T/Ts).
  EXPECT_NEAR(stepping.holding_command(), 0.4 * 9.0 / 90.0 / std::sqrt(1.0 - 9.0 / 300.0), 1e-12);
  run(stepping, stepping.holding_command(), 20.0);
  EXPECT_NEAR(stepping.motor_torque(), 9.0, 1e-9);
  EXPECT_NEAR(stepping.encoder(), 0.0, 1e-9);
}

TEST(FrictionTimeStepping, SlidesWhereFlowAndTorqueBalance) {
  FrictionAntenna sliding = antenna();
  sliding.supply_torque = 300.0;
  for (const double command : {1.5, 6.0, -6.0}) {
    FrictionTimeStepping stepping(sliding, step);
    run(stepping, command, 60.0);
    const double rate = stepping.motor_rate(), torque = stepping.motor_torque();
    const Drive& drive = sliding.linear.drive;
    EXPECT_NEAR(torque, friction_torque(sliding.friction.curve, rate) + 2.0 * rate,
                1e-4 * std::abs(torque));
    const double flow = command * std::sqrt(1.0 - std::abs(torque) / sliding.supply_torque);
    EXPECT_NEAR(drive.oil_stiffness * (flow - rate), drive.leakage_rate * torque,
                1e-3 * std::abs(torque));
    EXPECT_NEAR(stepping.tachometer(), rate, 1e-6 * std::abs(rate));
  }
}

TEST(FrictionTimeStepping, DissipatesTheFrictionWorkOfASlide) {
  // Coulomb friction Tc alone against an initial rate w0 of one inertia with soft oil: it stops
  // after J w0^2/(2 Tc). The rate comes from a short pulse of the valve through the oil.
  FrictionAntenna bare = antenna();
  bare.linear.drive.viscous_friction = 0.0;
  bare.linear.drive.oil_stiffness = 1e-3;
  bare.linear.drive.leakage_rate = 50.0;
  bare.friction = {{10.0, 10.0, 1.0, 0.0, 1.0, 0.0}, 0.0, 0.0, 0.01};
  FrictionTimeStepping stepping(bare, step);
  run(stepping, 1e7, 1.0);
  run(stepping, 0.0, 4.0);
  const double rate = stepping.motor_rate(), angle = stepping.encoder();
  ASSERT_GT(rate, 1.0);
  run(stepping, 0.0, 60.0);
  const double inertia = reflected_inertia(bare.linear);
  EXPECT_NEAR(stepping.encoder() - angle, 0.5 * inertia * rate * rate / 10.0,
              0.01 * (stepping.encoder() - angle));
}

TEST(FrictionTimeStepping, RefusesFrictionlessMotors) {
  FrictionAntenna frictionless = antenna();
  frictionless.friction.curve = {};
  EXPECT_THROW(FrictionTimeStepping(frictionless, step), InvalidInput);
  EXPECT_THROW(FrictionTimeStepping(antenna(), 0.0), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
