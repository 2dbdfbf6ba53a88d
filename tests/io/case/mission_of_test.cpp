#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/design/problem/pointing.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>

namespace boresight::io {
namespace {

Case reference() {
  return read_case(case_path("dss14-70m"));
}

TEST(MissionOf, ProblemIsOfTheCasesAntennaAndOfAnyOther) {
  const Case stated = reference();
  const plant::Antenna antenna = antenna_of(stated);
  const auto own = make_problem(stated);
  EXPECT_EQ(own.gear_ratio, gear_ratio(stated));
  EXPECT_EQ(own.plant.drive.oil_stiffness, linear_plant(antenna).drive.oil_stiffness);
  EXPECT_EQ(own.delay, stated.controller->delay.value);
  EXPECT_EQ(own.noise.encoder_rms, stated.sensors->encoder_noise.value * gear_ratio(stated));
  const auto bare = plant::set_to("motor.flywheel_disks", 0.0);
  EXPECT_EQ(make_problem(stated, {bare}).plant.drive.motor_inertia,
            make_problem(stated, changed(antenna, {bare})).plant.drive.motor_inertia);
  EXPECT_LT(make_problem(stated, {bare}).plant.drive.motor_inertia, own.plant.drive.motor_inertia);
}

TEST(MissionOf, AnotherGearRatioTakesTheNoiseWithIt) {
  const Case stated = reference();
  const auto own = make_problem(stated);
  const auto other =
      make_problem(stated, {plant::scaled_by("gear_train.stage[0].driven_teeth", 2.0)});
  EXPECT_NEAR(other.gear_ratio / own.gear_ratio, 2.0, 1e-12);
  EXPECT_NEAR(other.noise.encoder_rms / own.noise.encoder_rms, 2.0, 1e-12);
  EXPECT_NEAR(
      plant::antenna_inertia(other.plant.structure) / plant::antenna_inertia(own.plant.structure),
      0.25, 1e-12);
}

// SS is no loop structure: it comes beside the usual ones, and beside others where it is named.
TEST(AskedStructures, KnowAStateSpaceBesideLoops) {
  const Case stated = reference();
  const auto usual = asked_structures(stated);
  EXPECT_TRUE(usual.state_space);
  EXPECT_FALSE(usual.state_space_named);
  EXPECT_FALSE(asked_structures(stated, {"PI"}).state_space);
  const Case linear = parse_case(EditedCase().remove_table("simulation").text(), "case.toml");
  EXPECT_FALSE(asked_structures(linear).state_space) << "nothing shows its limit cycles";
  EXPECT_TRUE(asked_structures(linear, {"SS"}).state_space);
  // What an integral with a dead zone does depends on the size of the errors.
  EXPECT_EQ(asked_structures(stated, {"FULL+D"}).loops.size(), 1U);
  EXPECT_THROW(asked_structures(linear, {"FULL+D"}), InvalidInput);
  EXPECT_EQ(usual.loops.size(), 6U);
  const auto beside = asked_structures(stated, {"PI", "SS"});
  EXPECT_TRUE(beside.state_space);
  EXPECT_TRUE(beside.state_space_named);
  ASSERT_EQ(beside.loops.size(), 1U);
  EXPECT_EQ(beside.loops[0].name, "PI");
  const auto alone = asked_structures(stated, {"SS"});
  EXPECT_TRUE(alone.state_space);
  EXPECT_EQ(alone.loops.size(), usual.loops.size());
  EXPECT_FALSE(alone.empty());
  EXPECT_THROW(asked_structures(stated, {"SS", "PI", "SS"}), InvalidInput);

  const auto tuned = [](const std::string& names) {
    return parse_case(EditedCase().text() + "\n[tuning]\nstructures = [" + names + "]\n",
                      "case.toml");
  };
  const auto of_case = mission_of(tuned("'DPF', 'SS'")).structures;
  EXPECT_TRUE(of_case.state_space);
  EXPECT_TRUE(of_case.state_space_named);
  ASSERT_EQ(of_case.loops.size(), 1U);
  EXPECT_EQ(of_case.loops[0].name, "DPF");
  EXPECT_EQ(mission_of(tuned("'SS'")).structures.loops.size(), usual.loops.size());
  EXPECT_FALSE(asked_structures(tuned("'DPF', 'SS'"), {"PI"}).state_space);
  EXPECT_EQ(asked_structures(tuned("'DPF', 'SS'"), {"SS"}).loops.size(), 1U);
}

// Without integral action the mean wind leaves an error: a leaky integral and a state space do.
TEST(AskedStructures, HaveIntegralActionWhereNoStaticErrorIsAllowed) {
  Case stated = reference();
  change_goals(*stated.goals, {"static_encoder_error=0 mdeg"});
  EXPECT_EQ(mission_of(stated).stated_constraints.static_encoder_error, 0.0);
  const auto left = asked_structures(stated);
  EXPECT_FALSE(left.state_space);
  ASSERT_EQ(left.loops.size(), 4U);
  for (const auto& one : left.loops) EXPECT_TRUE(one.structure.has_integral_action()) << one.name;
  EXPECT_EQ(asked_structures(stated, {"PI"}).loops.size(), 1U);
  EXPECT_EQ(asked_structures(stated, {"PI", "LL+L"}).loops.size(), 2U) << "named";
  EXPECT_TRUE(asked_structures(stated, {"SS"}).state_space);
  change_goals(*stated.goals, {"static_encoder_error=0.1 mdeg"});
  EXPECT_TRUE(asked_structures(stated).state_space);
}

TEST(MissionOf, SupplyHoldsTheMeanTorqueOfItsWindSpeed) {
  const Case stated = reference();
  const auto problem = make_problem(stated);
  const double speed = torque_limited_wind_speed(stated, problem);
  EXPECT_NEAR(std::abs(plant::mean_wind_torque(problem.wind.site, speed)) / problem.gear_ratio,
              available_wind_torque(stated), 1e-9 * available_wind_torque(stated));
}

TEST(MissionOf, BudgetsAreTheRmsOfTheirLosses) {
  const Case stated = reference();
  const auto budgets = make_budgets(stated);
  ASSERT_EQ(budgets.size(), stated.budgets.size());
  EXPECT_NEAR(design::pointing_loss_db(budgets[0].rms, budgets[0].beamwidth,
                                       design::LossConvention::mean_loss_two_axes),
              stated.budgets[0].loss->value, 1e-12);
  for (const auto& budget : budgets) EXPECT_GE(budget.rms, tightest_budget(stated));
  Case free = stated;
  free.budgets.clear();
  EXPECT_NEAR(tightest_budget(free), 1e-3 * std::numbers::pi / 180.0, 1e-18);
}

TEST(MissionOf, CrestFactorAsksForTorqueThatTheSupplyHas) {
  Case stated = reference();
  stated.goals->crest_factor = stated.goals->sensitivity_peak;
  const auto goals = make_goals(stated);
  EXPECT_EQ(goals.gust_torque, available_wind_torque(stated));
  EXPECT_EQ(goals.gust_demand, largest_demand(stated));
  stated.drive->supply_pressure.value = 1e3;
  EXPECT_THROW(make_goals(stated), InvalidInput);
}

TEST(MissionOf, ClimateWeightsTheCasesWind) {
  Case stated = reference();
  EXPECT_TRUE(make_climate(stated).empty());
  stated.wind->climate = {{5.0, 0.75}, {12.0, 0.25}};
  const auto winds = make_climate(stated);
  ASSERT_EQ(winds.size(), 2U);
  EXPECT_EQ(winds[1].wind.mean_speed, 12.0);
  EXPECT_EQ(winds[1].weight, 0.25);
  EXPECT_EQ(winds[0].wind.site.dish_diameter, stated.antenna->dish_diameter.value);
}

TEST(MissionOf, PointsWhereTheCaseSaysBoth) {
  Case stated = reference();
  EXPECT_FALSE(mission_of(stated).pointing);
  stated.antenna->elevation = Quantity{};
  stated.antenna->elevation->value = 0.5;
  EXPECT_FALSE(mission_of(stated).pointing);
  stated.antenna->azimuth = Quantity{};
  stated.antenna->azimuth->value = 1.5;
  const auto pointing = mission_of(stated).pointing.value_or(plant::DishDirection{});
  EXPECT_EQ(pointing.azimuth, 1.5);
  EXPECT_EQ(pointing.elevation, 0.5);
}

}  // namespace
}  // namespace boresight::io
