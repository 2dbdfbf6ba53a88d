#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/problem/mission.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

using reference::demo_mission;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

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

// By default that of a sinusoid with the rms of the tightest budget.
TEST(Mission, AllowsALimitCycleAsStatedOrWithinTheTightestBudget) {
  Mission mission = demo_mission();
  mission.budgets.resize(1);
  mission.budgets[0].rms = 2e-5;
  EXPECT_NEAR(allowed_limit_cycle(mission), 2e-5 * std::sqrt(2.0), 1e-20);
  const double half_step = std::sqrt(3.0) * mission.antenna.sensors.encoder_noise;
  mission.limit_cycle_amplitude = 1.01 * half_step;
  EXPECT_EQ(allowed_limit_cycle(mission), 1.01 * half_step);
  EXPECT_NO_THROW(constraints(mission));
  // No loop senses less than half a step; which encoder would do is said.
  mission.limit_cycle_amplitude = 0.25 * half_step;
  EXPECT_THAT(
      [&] { (void)constraints(mission); },
      ThrowsMessage<InfeasibleRequirement>(AllOf(
          HasSubstr(fmt::format("at least {:.4g} mdeg", half_step / millidegree)),
          HasSubstr(fmt::format("steps of {:.4g} mdeg instead of {:.4g}",
                                0.5 * half_step / millidegree, 2.0 * half_step / millidegree)))));
  mission.antenna.sensors.encoder_noise = 0.0;
  EXPECT_NO_THROW(constraints(mission));
}

TEST(Mission, TightestBudgetIsTheLeastRms) {
  Mission mission = demo_mission();
  EXPECT_EQ(tightest_budget(mission), millidegree);
  mission.budgets.resize(2);
  mission.budgets[0].rms = 2e-5;
  mission.budgets[1].rms = 1e-5;
  EXPECT_EQ(tightest_budget(mission), 1e-5);
}

}  // namespace
}  // namespace boresight::design
