#include <algorithm>
#include <array>
#include <cmath>
#include <set>

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

TEST(PlantMembers, CornersCombineTheEndsOfWhatVariesWithLeastDamping) {
  Mission mission = reference::demo_mission();
  const double leakage = mission.antenna.drive.leakage_rate;
  mission.uncertainty.ranges = {{0.9, 1.1}, {0.8, 1.2}, {0.3 * leakage, leakage}, {2.0, 10.0}};
  mission.uncertainty.antenna_inertia = 0.1;
  const auto corners = corner_members(mission);
  ASSERT_EQ(corners.size(), 8U);
  const auto own = linear_plant(mission.antenna);
  std::set<std::array<bool, 3>> combinations;
  double least = 1e9, largest = 0.0;  // antenna inertia
  for (const auto& [name, plant] : corners) {
    EXPECT_DOUBLE_EQ(plant.drive.viscous_friction, 2.0 + 0.05 * 8.0);
    EXPECT_NEAR(plant.drive.leakage_rate, (0.3 + 0.05 * 0.7) * leakage, 1e-12 * leakage);
    EXPECT_DOUBLE_EQ(plant.drive.motor_inertia, own.drive.motor_inertia);
    const double inertia = plant::antenna_inertia(plant.structure);
    const double ratio = inertia / plant::antenna_inertia(own.structure);
    const bool soft_oil = plant.drive.oil_stiffness < own.drive.oil_stiffness;
    EXPECT_NEAR(plant.drive.oil_stiffness, (soft_oil ? 0.82 : 1.18) * own.drive.oil_stiffness,
                1e-9 * own.drive.oil_stiffness);
    combinations.insert({plant.structure.gear_stiffness < ratio * own.structure.gear_stiffness,
                         soft_oil, ratio < 1.0});
    least = std::min(least, inertia);
    largest = std::max(largest, inertia);
  }
  EXPECT_EQ(combinations.size(), 8U);
  // 90 % of the lognormal lie between the ends: exp(2 x 1.6449 x 0.1).
  EXPECT_NEAR(largest / least, std::exp(2.0 * 1.644854 * 0.1), 1e-6);

  mission.uncertainty.antenna_inertia = 0.0;
  mission.uncertainty.ranges.oil_stiffness = {1.0, 1.0};
  EXPECT_EQ(corner_members(mission).size(), 2U);
}

}  // namespace
}  // namespace boresight::design
