#include <cmath>

#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::plant {
namespace {

TEST(NonlinearDrive, SharesItsLinearNumbersWithTheLinearPlant) {
  const Antenna antenna = demo_antenna();
  const AntennaPlant linear = linear_plant(antenna);
  const NonlinearAntenna nonlinear = nonlinear_antenna(antenna);
  EXPECT_DOUBLE_EQ(nonlinear.oil.stiffness_1 + nonlinear.oil.stiffness_2,
                   linear.drive.oil_stiffness);
  EXPECT_EQ(nonlinear.motor_inertia, linear.drive.motor_inertia);
  EXPECT_EQ(nonlinear.gear.stiffness, linear.structure.gear_stiffness);
  EXPECT_EQ(nonlinear.valve.corner, linear.drive.valve_corner);
  EXPECT_EQ(nonlinear.tachometer_corner, linear.drive.tachometer_corner);
  EXPECT_EQ(nonlinear.friction.curve.coulomb_torque, antenna.friction_curve.coulomb_torque);
  EXPECT_NO_THROW(to_feedback_system(nonlinear));
}

TEST(NonlinearDrive, OpensItsValveWithinTheStrokeTime) {
  const NonlinearAntenna nonlinear = nonlinear_antenna(demo_antenna());
  EXPECT_DOUBLE_EQ(nonlinear.valve.stroke_limit / nonlinear.valve.slew_limit, 0.05);
}

TEST(NonlinearDrive, WithoutBacklashNeedsNoPreload) {
  Antenna antenna = demo_antenna();
  antenna.nonlinear->backlash = std::numeric_limits<double>::infinity();
  const NonlinearAntenna nonlinear = nonlinear_antenna(antenna);
  EXPECT_TRUE(std::isinf(nonlinear.gear.backlash));
  EXPECT_EQ(nonlinear.gear.preload_torque, 0.0);
}

TEST(NonlinearDrive, OffsetFollowsTheElevation) {
  Antenna antenna = demo_antenna();
  antenna.elevation = 1.0;
  antenna.nonlinear->offset_cosine = 3.0;
  const double turned = 0.2;  // rad at the sky
  EXPECT_DOUBLE_EQ(offset_torque(offset_torque(antenna), sky_to_motor(antenna, turned)).value,
                   antenna.nonlinear->offset_torque + 3.0 * std::cos(1.0 + turned));
  antenna.nonlinear.reset();
  EXPECT_EQ(offset_torque(offset_torque(antenna), 0.0).value, 0.0);
}

TEST(NonlinearDrive, NeedsItsNumbers) {
  Antenna antenna = demo_antenna();
  antenna.nonlinear.reset();
  EXPECT_THROW(nonlinear_antenna(antenna), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
