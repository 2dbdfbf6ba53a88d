#include <cmath>

#include <gtest/gtest.h>

#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

Mission demo_mission() {
  Mission mission;
  mission.antenna = plant::demo_antenna();
  mission.wind.site = {1.1, 0.005, 0.1, 0.0, 10.0, 70.0, {}};
  mission.wind.mean_speed = 10.0;
  return mission;
}

TEST(Mission, ProblemIsOfItsAntennaAndOfAnyOther) {
  const Mission mission = demo_mission();
  const auto own = tracking_problem(mission);
  EXPECT_EQ(own.gear_ratio, gear_ratio(mission.antenna));
  EXPECT_EQ(own.delay, mission.antenna.dead_time);
  EXPECT_EQ(own.wind.mean_speed, 10.0);
  const auto bare = plant::set_to("motor.flywheel_disks", 0.0);
  EXPECT_LT(tracking_problem(mission, {bare}).plant.drive.motor_inertia,
            own.plant.drive.motor_inertia);
  EXPECT_EQ(tracking_problem(mission, {bare}).plant.drive.motor_inertia,
            tracking_problem(mission, changed(mission.antenna, {bare})).plant.drive.motor_inertia);
}

TEST(Mission, SupplyHoldsTheMeanTorqueOfItsWindSpeed) {
  Mission mission = demo_mission();
  const double left = plant::available_wind_torque(mission.antenna);
  ASSERT_GT(left, 0.0);
  const double speed = torque_limited_wind_speed(mission);
  EXPECT_NEAR(
      std::abs(plant::mean_wind_torque(mission.wind.site, speed)) / gear_ratio(mission.antenna),
      left, 1e-9 * left);
  mission.antenna.friction_curve.coulomb_torque = 2.0 * plant::supply_torque(mission.antenna);
  EXPECT_EQ(torque_limited_wind_speed(mission), 0.0);
}

TEST(Mission, GustsAreLimitedByWhatTheDriveHas) {
  Mission mission = demo_mission();
  EXPECT_FALSE(constraints(mission).ask_for_gusts());
  mission.limits_gusts = true;
  EXPECT_EQ(constraints(mission).gust_torque, plant::available_wind_torque(mission.antenna));
  EXPECT_EQ(constraints(mission).gust_demand, plant::largest_demand(mission.antenna));
  mission.antenna.drive.supply_pressure = 1e3;
  EXPECT_THROW(constraints(mission), InvalidInput);
}

TEST(Mission, TightestBudgetIsTheLeastRms) {
  Mission mission = demo_mission();
  EXPECT_EQ(tightest_budget(mission), millidegree);
  mission.budgets.resize(2);
  mission.budgets[0].rms = 2e-5;
  mission.budgets[1].rms = 1e-5;
  EXPECT_EQ(tightest_budget(mission), 1e-5);
}

TEST(PlantMembers, AreCornersAndAHypercubeThatRepeatsWithItsSeed) {
  Mission mission = demo_mission();
  const double leakage = mission.antenna.drive.leakage_rate;
  mission.uncertainty.ranges = {{0.9, 1.1}, {0.8, 1.33}, {0.3 * leakage, leakage}, {0.0, 10.0}};
  mission.uncertainty.draws = 8;
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
