#include <gtest/gtest.h>

#include <boresight/identification/grey_box/identified_antenna.hpp>
#include <boresight/numerics/error.hpp>

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
