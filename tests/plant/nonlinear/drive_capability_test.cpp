#include <cmath>

#include <gtest/gtest.h>

#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::plant {
namespace {

TEST(LoadedDrive, TakesUpItsWholeTorqueAtTheAttainableRate) {
  const Antenna antenna = demo_antenna();
  const LoadedDrive drive(antenna);
  const double stroke = largest_demand(antenna);
  const double rate = drive.attainable_rate(stroke);
  EXPECT_GT(rate, 0.0);
  EXPECT_LT(rate, stroke);
  EXPECT_NEAR(drive.excess(rate, stroke), 0.0, 1e-6 * drive.available());
  EXPECT_LT(drive.attainable_rate(0.9 * stroke), rate);
}

TEST(LoadedDrive, HoldsFrictionAndTheOffsetThatResists) {
  Antenna antenna = demo_antenna();
  antenna.nonlinear.value().offset_torque = 7.0;
  const double rate = 2.0;
  const double friction = friction_torque(antenna.friction_curve, rate);
  const double offset = offset_torque(offset_torque(antenna), 0.0).value;
  EXPECT_NEAR(LoadedDrive(antenna).load(rate), friction + std::abs(offset), 1e-12);
  antenna.nonlinear.value().offset_torque *= -1.0;
  antenna.nonlinear.value().offset_cosine *= -1.0;
  antenna.nonlinear.value().offset_sine *= -1.0;
  EXPECT_NEAR(LoadedDrive(antenna).load(rate), friction + std::abs(offset), 1e-12);
}

TEST(DriveCapability, SlewMarginIsOverWhatSlewingTakesAndNoneWithoutAStroke) {
  Antenna antenna = demo_antenna();
  const auto own = slew_rate_margin(antenna);
  ASSERT_TRUE(own.has_value());
  antenna.drive.slew_rate *= 2.0;
  EXPECT_NEAR(slew_rate_margin(antenna).value() / *own, 0.5, 1e-12);
  antenna.nonlinear.reset();
  EXPECT_FALSE(slew_rate_margin(antenna).has_value());
  EXPECT_EQ(largest_demand(antenna), sky_to_motor(antenna, antenna.drive.slew_rate));
}

// Flow scales with the root of the drop, and fills the motors' displacements.
TEST(DriveCapability, RatedFlowGivesTheNoLoadRate) {
  Antenna antenna = demo_antenna();
  antenna.nonlinear.reset();
  antenna.drive.rated_flow = 1e-3;
  EXPECT_FALSE(rated_stroke(antenna).has_value());
  antenna.drive.rated_pressure_drop = antenna.drive.supply_pressure;
  const HydraulicDrive& motors = antenna.hydraulics;
  EXPECT_NEAR(rated_stroke(antenna).value() * motors.motor_count * motors.displacement, 1e-3,
              1e-15);
  const double own = rated_stroke(antenna).value();
  antenna.drive.return_pressure = 0.75 * antenna.drive.supply_pressure;
  EXPECT_NEAR(rated_stroke(antenna).value() / own, 0.5, 1e-12);
  EXPECT_EQ(largest_demand(antenna), rated_stroke(antenna).value());
}

TEST(DriveCapability, WindHasWhatFrictionAndOffsetLeave) {
  Antenna antenna = demo_antenna();
  const double rate = sky_to_motor(antenna, antenna.drive.tracking_rate);
  const double offset = offset_torque(offset_torque(antenna), 0.0).value;
  EXPECT_NEAR(available_wind_torque(antenna) + friction_torque(antenna.friction_curve, rate) +
                  std::abs(offset),
              supply_torque(antenna), 1e-9 * supply_torque(antenna));
  antenna.friction_curve.coulomb_torque = 2.0 * supply_torque(antenna);
  EXPECT_EQ(available_wind_torque(antenna), 0.0);
}

TEST(DriveCapability, DisksAtUnitRatioMakeMotorsAsHeavyAsTheirLoad) {
  const Antenna antenna = demo_antenna();
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  const auto disks = disks_at_unit_ratio(antenna, load);
  ASSERT_TRUE(disks.has_value());
  EXPECT_NEAR(motor_inertia(changed(antenna, {set_to("motor.flywheel_disks", *disks)})), load,
              1e-12 * load);
  EXPECT_FALSE(disks_at_unit_ratio(antenna, 1e-9).has_value());
}

TEST(DriveCapability, FallingFrictionIsNoViscousFriction) {
  Antenna antenna = demo_antenna();
  antenna.friction_curve.saturating_torque = 0.0;
  antenna.friction_curve.breakaway_torque = 10.0 * antenna.friction_curve.coulomb_torque;
  antenna.friction_curve.stribeck_rate = sky_to_motor(antenna, antenna.drive.tracking_rate);
  EXPECT_LT(tracking_slope(antenna), 0.0);
  EXPECT_EQ(tracking_friction(antenna), 0.0);
  EXPECT_EQ(largest_viscous_friction(antenna), antenna.drive.viscous_friction);
}

}  // namespace
}  // namespace boresight::plant
