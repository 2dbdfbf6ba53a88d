#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/ensembles/plant_members.hpp>

namespace boresight::design {
namespace {

TEST(PlantMembers, AreCornersAndAHypercubeThatRepeatsWithItsSeed) {
  Mission mission = reference::demo_mission();
  const double leakage = mission.antenna.drive.leakage_rate;
  mission.uncertainty.ranges = {{0.9, 1.1}, {0.8, 1.33}, {0.3 * leakage, leakage}, {0.0, 10.0}};
  mission.uncertainty.random_samples = 8;
  const auto members = plant_members(mission, 1);
  ASSERT_EQ(members.size(), 14U);
  const auto own = linear_plant(mission.antenna);
  EXPECT_EQ(members[0].plant.drive.oil_stiffness, own.drive.oil_stiffness);
  EXPECT_DOUBLE_EQ(members[4].plant.drive.oil_stiffness, 1.33 * own.drive.oil_stiffness);
  EXPECT_DOUBLE_EQ(members[5].plant.drive.leakage_rate, 0.3 * leakage);
  const auto again = plant_members(mission, 1), other = plant_members(mission, 2);
  EXPECT_EQ(members[9].plant.drive.leakage_rate, again[9].plant.drive.leakage_rate);
  EXPECT_NE(members[9].plant.drive.leakage_rate, other[9].plant.drive.leakage_rate);
}

}  // namespace
}  // namespace boresight::design
