#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/identification/grey_box/identified_antenna.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::identification {
namespace {

DriveEstimate estimate() {
  DriveEstimate found;
  found.inertia = 1.79;
  found.motor_inertia = 1.21;
  found.oil_stiffness = 51.0;
  found.bulk_modulus = 1.2e9;
  found.leakage_rate = 0.6;
  found.lowest_frequency = 1.9;
  found.friction = {11.0, 17.0, 0.16, 60.0, 1.4, 2.2};
  found.offset_as_recorded = -4.0;
  found.bristle_stiffness = 2000.0;
  found.bristle_damping = 4.0;
  return found;
}

plant::Antenna identified(const plant::Antenna& antenna, const DriveEstimate& found) {
  return changed(antenna, identified_changes(antenna, found));
}

TEST(IdentifiedAntenna, HasTheEstimatesPlant) {
  const plant::Antenna antenna = identified(plant::demo_antenna(), estimate());
  const auto plant = linear_plant(antenna);
  EXPECT_NEAR(plant::reflected_inertia(plant), estimate().inertia, 1e-12);
  EXPECT_NEAR(motor_inertia(antenna), estimate().motor_inertia, 1e-12);
  EXPECT_NEAR(plant.drive.oil_stiffness, estimate().oil_stiffness, 1e-10);
  EXPECT_EQ(antenna.hydraulics.bulk_modulus, estimate().bulk_modulus);
  EXPECT_EQ(plant.drive.leakage_rate, estimate().leakage_rate);
  EXPECT_EQ(antenna.nonlinear->offset_torque, estimate().offset_as_recorded);
}

TEST(IdentifiedAntenna, HasThatStiffnessUnderEitherConvention) {
  plant::Antenna antenna = plant::demo_antenna();
  antenna.hydraulics.efficiency_in_stiffness = plant::EfficiencyInStiffness::none;
  EXPECT_NEAR(oil_stiffness(identified(antenna, estimate())), estimate().oil_stiffness, 1e-10);
}

TEST(IdentifiedAntenna, MovesAllFrequenciesInOneProportion) {
  const plant::Antenna own = plant::demo_antenna();
  const plant::Antenna moved = identified(own, estimate());
  EXPECT_EQ(moved.structure.locked_rotor_frequency, 1.9);
  for (std::size_t i = 0; i < own.structure.modes.size(); ++i) {
    EXPECT_NEAR(moved.structure.modes[i].frequency / own.structure.modes[i].frequency,
                1.9 / own.structure.locked_rotor_frequency, 1e-12);
  }
  DriveEstimate rigid = estimate();
  rigid.lowest_frequency = 0.0;
  EXPECT_EQ(identified(own, rigid).structure.modes[0].frequency, own.structure.modes[0].frequency);
}

TEST(IdentifiedAntenna, TakesFrictionSlopeAndValveLagWhereRecordsShowThem) {
  const plant::Antenna own = plant::demo_antenna();
  DriveEstimate found = estimate();
  found.tracking_slope = 12.5;
  found.valve_lag = 0.02;
  EXPECT_EQ(identified(own, found).drive.viscous_friction, own.drive.viscous_friction);
  EXPECT_EQ(identified(own, found).drive.valve_frequency, own.drive.valve_frequency);
  IdentifiedParts parts;
  parts.friction_slope = parts.valve_lag = true;
  const plant::Antenna shown = changed(own, identified_changes(own, found, parts));
  EXPECT_EQ(shown.drive.viscous_friction, 12.5);
  // The phase of a valve of second order falls by 2 zeta/w at low frequencies.
  const double lag =
      2.0 * own.drive.valve_damping / (2.0 * std::numbers::pi * shown.drive.valve_frequency);
  EXPECT_NEAR(lag, 0.02, 1e-15);
  found.tracking_slope = -3.0;
  EXPECT_EQ(changed(own, identified_changes(own, found, parts)).drive.viscous_friction, 0.0);
}

TEST(IdentifiedAntenna, KeepsItsOwnNumbersWhereRecordsShowNothing) {
  const plant::Antenna own = plant::demo_antenna();
  IdentifiedParts parts;
  parts.leakage_rate = parts.friction_curve = parts.offset_torque = parts.bristles = false;
  const plant::Antenna shown = changed(own, identified_changes(own, estimate(), parts));
  EXPECT_EQ(shown.drive.leakage_rate, own.drive.leakage_rate);
  EXPECT_EQ(shown.friction_curve.coulomb_torque, own.friction_curve.coulomb_torque);
  EXPECT_EQ(shown.nonlinear->offset_torque, own.nonlinear->offset_torque);
  EXPECT_EQ(shown.nonlinear->bristle_stiffness, own.nonlinear->bristle_stiffness);
  EXPECT_NEAR(plant::reflected_inertia(linear_plant(shown)), estimate().inertia, 1e-12);
}

TEST(IdentifiedAntenna, HasEachFrequencyOfTheLockedRotorThatRecordsShow) {
  const plant::Antenna own = plant::demo_antenna();
  DriveEstimate found = estimate();
  found.lowest_frequency = 2.03;
  found.mode_frequency.resize(3);
  found.mode_frequency << 2.03, 3.18, 4.47;
  IdentifiedParts parts;
  parts.frequencies = {true, false, true};
  const plant::Antenna shown = changed(own, identified_changes(own, found, parts));
  const auto held = plant::motors_held_modes(linear_plant(shown).structure);
  EXPECT_NEAR(held[0].frequency, 2.03, 1e-9);
  EXPECT_GT(std::abs(held[1].frequency - 3.18), 0.02);
  EXPECT_NEAR(held[2].frequency, 4.47, 1e-7);
}

TEST(IdentifiedNumbers, HaveTheScatterOfTheSamples) {
  const plant::Antenna own = plant::demo_antenna();
  std::vector<DriveEstimate> random_samples(2, estimate());
  random_samples[0].leakage_rate = 0.57;
  random_samples[1].leakage_rate = 0.63;
  random_samples.push_back(estimate());
  random_samples.back().inertia =
      random_samples.back().motor_inertia;  // no antenna left: counts for nothing
  const auto numbers = identified_numbers(own, estimate(), random_samples);
  const auto leakage = std::ranges::find(numbers, "drive.leakage_rate", &IdentifiedNumber::path);
  ASSERT_NE(leakage, numbers.end());
  EXPECT_EQ(leakage->value, 0.6);
  EXPECT_NEAR(leakage->standard_uncertainty, 0.03, 1e-12);
}

TEST(IdentifiedAntenna, RefusesWhatIsNoAntenna) {
  const plant::Antenna own = plant::demo_antenna();
  DriveEstimate light = estimate();
  light.inertia = light.motor_inertia;
  EXPECT_THROW(identified_changes(own, light), NumericalFailure);
  DriveEstimate contradicted = estimate();
  contradicted.contradicted = true;
  EXPECT_THROW(identified_changes(own, contradicted), NumericalFailure);
}

}  // namespace
}  // namespace boresight::identification
