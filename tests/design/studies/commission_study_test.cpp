#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/studies/fixed_controller.hpp"
#include <boresight/design/studies/commission_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

Mission mission_of_test() {
  Mission mission = reference::uncertain_mission();
  mission.uncertainty.random_samples = 2;
  return mission;
}

CommissionStudy study_of(const Mission& mission, unsigned threads) {
  CommissioningOptions options;
  options.threads = threads;
  return study_commission(mission, {EnsembleSource::ranges, plant_members(mission, 1)},
                          reference::fixed_controller("PI", 1.0).design.tuning.controller, options,
                          1);
}

TEST(StudyCommission, StepsLeaveEveryPlantItsValveAndSupply) {
  const Mission mission = mission_of_test();
  const CommissionStudy study = study_of(mission, 1);
  ASSERT_EQ(study.steps.size(), study.plan.stages.size());
  ASSERT_GE(study.steps.size(), 2U);
  for (std::size_t i = 0; i < study.steps.size(); ++i) {
    const auto& expected = study.plan.stages[i].expected;
    const double at_motor = plant::sky_to_motor(mission.antenna, study.steps[i]);
    EXPECT_LE(at_motor * expected.largest_demand.largest,
              0.2 * plant::largest_demand(mission.antenna) * (1.0 + 1e-9));
    EXPECT_LE(at_motor * expected.largest_torque.largest,
              0.2 * plant::supply_torque(mission.antenna) * (1.0 + 1e-9));
    // 1, 2 or 5 times a power of ten.
    const double decades = std::log10(study.steps[i] / millidegree);
    const double mantissa = std::pow(10.0, decades - std::floor(decades + 1e-9));
    EXPECT_THAT(mantissa,
                testing::AnyOf(testing::DoubleNear(1.0, 1e-6), testing::DoubleNear(2.0, 1e-6),
                               testing::DoubleNear(5.0, 1e-6)));
  }
}

TEST(StudyCommission, MovesAtATwentiethOfTheSlewRate) {
  const Mission mission = mission_of_test();
  const CommandedMove move = commissioning_move(mission);
  EXPECT_NEAR(plant::motor_to_sky(mission.antenna, move.rate),
              0.05 * mission.antenna.drive.slew_rate, 1e-12);
  EXPECT_NEAR(move.rate / move.acceleration, 2.0, 1e-12);
}

TEST(StudyCommission, BeginsWithThePresentControllerWhateverTheThreads) {
  Mission mission = mission_of_test();
  auto present = reference::fixed_controller("PI", 1.0).design.tuning.controller;
  present.gains[0] *= 0.5;
  mission.present_controllers = {{"PI", present}};
  const CommissionStudy one = study_of(mission, 1), two = study_of(mission, 2);
  EXPECT_EQ(one.plan.stages.front().kind, StageKind::as_found);
  EXPECT_EQ(one.plan.stages.front().controller.controller.gains, present.gains);
  ASSERT_EQ(one.steps.size(), two.steps.size());
  for (std::size_t i = 0; i < one.steps.size(); ++i) EXPECT_EQ(one.steps[i], two.steps[i]);
  EXPECT_EQ(one.limit_cycle.has_value(), two.limit_cycle.has_value());
}

TEST(ActingGains, AreThoseOfLoopsThatAreClosed) {
  StageController open{reference::fixed_controller("PI", 1.0).design.tuning.controller, true,
                       false};
  StageController closed = open;
  closed.position_open = false;
  const auto symbols = [](const StageController& stage, const StageController* before,
                          bool changed_only) {
    std::vector<std::string> found;
    for (const auto& gain : acting_gains(stage, before)) {
      if (!changed_only || gain.changed) {
        found.push_back(stage.controller.structure.gains().at(gain.place).symbol);
      }
    }
    return found;
  };
  using testing::ElementsAre;
  EXPECT_THAT(symbols(open, nullptr, false), ElementsAre("kr", "wi", "wp"));
  EXPECT_THAT(symbols(closed, nullptr, false), ElementsAre("kr", "wi", "wp", "kp", "wip"));
  // The first stage changes nothing; the loop that is closed brings its gains.
  EXPECT_TRUE(symbols(open, nullptr, true).empty());
  EXPECT_THAT(symbols(closed, &open, true), ElementsAre("kp", "wip"));
  open.controller.gains[1] *= 2.0;
  EXPECT_THAT(symbols(closed, &open, true), ElementsAre("wi", "kp", "wip"));
  EXPECT_TRUE(symbols(closed, &closed, true).empty());
}

// Stages are for every plant: a nominal design will not do, nor one that breaks a constraint.
TEST(Commissionable, IsARobustControllerThatMeetsEveryConstraint) {
  ControllerStudy study;
  EXPECT_EQ(commissionable(study), nullptr);
  TunedController row;
  row.structure = "PI";
  row.wind_speed = 10.0;
  row.tuned_for = TunedFor::robust;
  row.constraints_met = true;
  row.design = reference::fixed_controller("PI", 1.0).design;
  row.design.boresight_rms = row.boresight_rms = millidegree;
  row.ensemble.emplace();
  study.tuned.wind_speeds = {10.0};
  study.tuned.controllers = {row};
  ASSERT_NE(commissionable(study), nullptr);
  EXPECT_EQ(commissionable(study)->structure, "PI");
  study.tuned.controllers[0].tuned_for = TunedFor::nominal;
  EXPECT_EQ(commissionable(study), nullptr);
  study.tuned.controllers[0].tuned_for = TunedFor::robust;
  study.tuned.controllers[0].constraints_met = false;
  EXPECT_EQ(commissionable(study), nullptr);
}

}  // namespace
}  // namespace boresight::design
