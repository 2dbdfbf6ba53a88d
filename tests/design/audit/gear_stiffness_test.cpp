#include <gtest/gtest.h>

#include <boresight/design/audit/gear_stiffness.hpp>

namespace boresight::design {
namespace {

plant::StructureSpecification one_mode(double frequency) {
  plant::StructureSpecification antenna;
  antenna.antenna_inertia = 1.0;
  antenna.locked_rotor_frequency = 2.0;
  antenna.gear_damping_ratio = 0.01;
  antenna.bull_gear_wind_fraction = 0.3;
  antenna.bull_gear_beam_weight = 0.3;
  plant::StructureSpecification::Mode mode;
  mode.frequency = frequency;
  mode.damping_ratio = 0.01;
  mode.inertia_fraction = 0.7;
  mode.wind_fraction = mode.beam_weight = 0.7;
  antenna.modes = {mode};
  return antenna;
}

TEST(ModeFrequencyFor, IsTheFrequencyThatTheStiffnessWasMadeWith) {
  for (const double frequency : {2.1, 3.0, 40.0}) {
    const double stiffness = plant::make_structure(one_mode(frequency)).gear_stiffness;
    const auto found = mode_frequency_for(one_mode(5.0), 0, stiffness);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, frequency, 1e-9 * frequency);
  }
}

TEST(ModeFrequencyFor, IsNoneBeyondARigidOrASoftMode) {
  const double rigid = plant::make_structure(one_mode(1000.0)).gear_stiffness;
  const double soft = plant::make_structure(one_mode(2.0 * 1.001)).gear_stiffness;
  EXPECT_GT(soft, rigid);
  EXPECT_FALSE(mode_frequency_for(one_mode(5.0), 0, 0.99 * rigid));
  EXPECT_FALSE(mode_frequency_for(one_mode(5.0), 0, 1.01 * soft));
}

}  // namespace
}  // namespace boresight::design
