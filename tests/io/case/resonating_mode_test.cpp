#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/resonating_mode.hpp>

namespace boresight::io {
namespace {

TEST(ResonatingMode, IsTheHydraulicOneUnlessTheCaseSaysThatOfTheOil) {
  Case stated = read_case(case_path("dss14-70m"));
  const auto plant = make_plant(stated);
  const auto modes = plant::plant_modes(plant);
  EXPECT_EQ(resonating_mode(stated, plant).frequency, plant::hydraulic_mode(modes).frequency);
  stated.resonance->of_oil = true;
  EXPECT_EQ(resonating_mode(stated, plant).frequency, plant::mode_of_oil(modes).frequency);
}

TEST(ResonatingMode, AStiffStructureRingsAsRigidAndASoftOneDoesNot) {
  Case stated = read_case(case_path("dss14-70m"));
  const auto scale = [&](double factor) {
    stated.structure->locked_rotor_frequency.value *= factor;
    for (auto& mode : stated.structure->modes) mode.frequency.value *= factor;
  };
  scale(10.0);
  EXPECT_TRUE(rings_as_rigid(stated));
  scale(0.02);
  EXPECT_FALSE(rings_as_rigid(stated));
}

TEST(ResonatingMode, HasLittleOfTheOilWhereAnotherHasMore) {
  plant::PlantMode soft, oil;
  soft.oil_fraction = 0.2;
  soft.gear_fraction = 0.7;
  oil.oil_fraction = 0.8;
  EXPECT_TRUE(little_of_oil(soft, oil));
  EXPECT_FALSE(little_of_oil(oil, oil));
  soft.damping_ratio = 1.2;
  EXPECT_FALSE(little_of_oil(soft, oil));
}

}  // namespace
}  // namespace boresight::io
