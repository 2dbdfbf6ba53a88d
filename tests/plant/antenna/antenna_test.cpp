#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Antenna, DemoHasTheGearTrainAndMotorsThatSommervillePrints) {
  const Antenna antenna = demo_antenna();
  // Rows 1 to 5 of Table 3, and four motors with 24 disks each of section II.
  EXPECT_NEAR(gear_train_inertia(antenna), 0.21719, 2e-4);
  EXPECT_NEAR(motor_inertia(antenna), 4.0 * 0.3007, 1e-12);
  const double ratio = 134.0 * 101.0 * 113.0 * 77.0 * 754.0 / (20.0 * 21.0 * 23.0 * 20.0 * 16.0);
  EXPECT_NEAR(gear_ratio(antenna) / ratio, 1.0, 1e-14);
  EXPECT_NEAR(antenna_inertia(antenna) * ratio * ratio / antenna.inertia, 1.0, 1e-14);
}

TEST(Antenna, DemoIsTheAntennaThatTheTestsReferTo) {
  const AntennaPlant demo = linear_plant(demo_antenna());
  const AntennaPlant expected = reference::antenna();
  EXPECT_DOUBLE_EQ(demo.drive.oil_stiffness, expected.drive.oil_stiffness);
  // Table 3 rounds its rows.
  EXPECT_NEAR(demo.drive.motor_inertia, expected.drive.motor_inertia, 2e-4);
  EXPECT_DOUBLE_EQ(demo.structure.gear_stiffness, expected.structure.gear_stiffness);
  EXPECT_DOUBLE_EQ(demo.structure.bull_gear_inertia, expected.structure.bull_gear_inertia);
  EXPECT_DOUBLE_EQ(demo.drive.valve_corner, expected.drive.valve_corner);
}

TEST(Antenna, SkyAndMotorAreOneGearRatioApart) {
  const Antenna antenna = demo_antenna();
  EXPECT_DOUBLE_EQ(sky_to_motor(antenna, 1.0), gear_ratio(antenna));
  EXPECT_DOUBLE_EQ(motor_to_sky(antenna, sky_to_motor(antenna, 0.3)), 0.3);
}

TEST(Antenna, EachDiskAddsItsInertiaOnEveryMotor) {
  Antenna antenna = demo_antenna();
  const double built = motor_inertia(antenna);
  antenna.flywheels.disks -= 10.0;
  EXPECT_NEAR(built - motor_inertia(antenna), 4.0 * 10.0 * 0.012358, 1e-12);
}

TEST(Antenna, NumbersFoundAtTheShaftReplaceThoseOfTheParts) {
  Antenna antenna = demo_antenna();
  antenna.at_shaft = {.antenna_inertia = 0.5,
                      .motor_inertia = 1.0,
                      .gear_train_inertia = 0.25,
                      .oil_stiffness = 80.0};
  const AntennaPlant plant = linear_plant(antenna);
  EXPECT_DOUBLE_EQ(antenna_inertia(plant.structure), 0.5);
  EXPECT_DOUBLE_EQ(plant.drive.motor_inertia, 1.25);
  EXPECT_DOUBLE_EQ(plant.drive.oil_stiffness, 80.0);
}

TEST(Antenna, WindTorqueFactorScalesWhatTheWindActsOnAndNoDynamics) {
  Antenna antenna = demo_antenna();
  const AntennaPlant own = linear_plant(antenna);
  antenna.structure.wind_torque_factor = 1.5;
  const AntennaPlant more = linear_plant(antenna);
  for (std::size_t i = 0; i < own.structure.modes.size(); ++i) {
    EXPECT_DOUBLE_EQ(more.structure.modes[i].wind_fraction,
                     1.5 * own.structure.modes[i].wind_fraction);
    EXPECT_DOUBLE_EQ(more.structure.modes[i].stiffness, own.structure.modes[i].stiffness);
  }
}

TEST(Antenna, DemoIsValid) {
  EXPECT_NO_THROW(validate(demo_antenna()));
}

TEST(Antenna, NamesTheNumberThatNoAntennaHas) {
  const auto refused = [](auto spoil) {
    Antenna antenna = demo_antenna();
    spoil(antenna);
    return [antenna] { validate(antenna); };
  };
  EXPECT_THAT(reference::Call(refused([](Antenna& one) { one.inertia = 0.0; })),
              ThrowsMessage<InvalidInput>(HasSubstr("inertia")));
  EXPECT_THAT(reference::Call(refused(
                  [](Antenna& one) { one.dead_time = std::numeric_limits<double>::quiet_NaN(); })),
              ThrowsMessage<InvalidInput>(HasSubstr("dead time")));
  EXPECT_THAT(reference::Call(refused([](Antenna& one) { one.drive.leakage_rate = -1.0; })),
              ThrowsMessage<InvalidInput>(HasSubstr("leakage rate")));
  EXPECT_THAT(
      reference::Call(refused([](Antenna& one) { one.structure.locked_rotor_frequency = 3.0; })),
      ThrowsMessage<InvalidInput>(HasSubstr("locked-rotor frequency")));
  EXPECT_THAT(reference::Call(
                  refused([](Antenna& one) { one.gear_train.stages.front().driving_teeth = 0.0; })),
              ThrowsMessage<InvalidInput>(HasSubstr("tooth counts")));
  EXPECT_THAT(reference::Call(refused([](Antenna& one) { one.hydraulics.bulk_modulus = 0.0; })),
              ThrowsMessage<InvalidInput>(HasSubstr("bulk modulus")));
}

}  // namespace
}  // namespace boresight::plant
