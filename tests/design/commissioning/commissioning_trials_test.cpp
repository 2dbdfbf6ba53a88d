#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/planned_stages.hpp"
#include <boresight/design/commissioning/commissioning_trials.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

constexpr std::size_t plants = 60;

CommissioningTrials trials_of(unsigned threads) {
  const auto& planned = reference::planned_stages();
  TrialOptions options;
  options.threads = threads;
  return try_stages(planned.mission, planned.distribution, planned.plan, planned.move, plants,
                    options);
}

// The brackets are 99 % prediction intervals of each quantity: of five at once some more leave.
TEST(TryStages, FreshPlantsStayWithinTheBrackets) {
  const auto trials = trials_of(1);
  ASSERT_EQ(trials.stages.size(), reference::planned_stages().plan.stages.size());
  EXPECT_EQ(trials.stable, plants);
  EXPECT_LE(trials.aborted, plants * 5 / 100);
  for (const StageTrial& trial : trials.stages) {
    EXPECT_LE(trials.passing, trial.passing);
    EXPECT_GE(trials.aborted, trial.aborted);
    EXPECT_EQ(trial.plants, plants);
    EXPECT_EQ(trial.stable, plants);
    EXPECT_GE(trial.passing, plants * 85 / 100);
    EXPECT_LE(trial.aborted, plants * 2 / 100);
    EXPECT_EQ(trial.worst.has_value(), trial.worst_outside > 0);
  }
}

TEST(TryStages, AreTheSameForAnyNumberOfThreads) {
  const auto one = trials_of(1);
  const auto two = trials_of(2);
  EXPECT_EQ(one.passing, two.passing);
  for (std::size_t i = 0; i < one.stages.size(); ++i) {
    EXPECT_EQ(one.stages[i].passing, two.stages[i].passing);
    EXPECT_EQ(one.stages[i].worst_outside, two.stages[i].worst_outside);
  }
}

TEST(TryStages, RefusesNoPlantsAndStopsWhenAsked) {
  const auto& planned = reference::planned_stages();
  EXPECT_THROW(try_stages(planned.mission, planned.distribution, planned.plan, planned.move, 0, {}),
               InvalidInput);
  TrialOptions options;
  options.stop = [] { return true; };
  EXPECT_THROW(
      try_stages(planned.mission, planned.distribution, planned.plan, planned.move, 1, options),
      Interrupted);
}

const FaultTrial& trial_of(const std::vector<FaultTrial>& trials, const std::string& fault) {
  const auto found = std::ranges::find(trials, fault, &FaultTrial::fault);
  EXPECT_NE(found, trials.end()) << fault;
  return *found;
}

TEST(TryFaults, WrongSignsOscillateInTheFirstStageThatClosesTheirLoop) {
  const auto& planned = reference::planned_stages();
  const auto trials =
      try_faults(planned.mission, planned.plan, planned.move, usual_faults(4.0, true), {});
  for (const char* fault : {"tachometer with the wrong sign", "valve with the wrong sign"}) {
    const FaultTrial& trial = trial_of(trials, fault);
    ASSERT_TRUE(trial.detected.has_value()) << fault;
    EXPECT_EQ(*trial.detected, 0U) << fault;
    EXPECT_FALSE(trial.evaluation.stable) << fault;
  }
  const FaultTrial& encoder = trial_of(trials, "encoder with the wrong sign");
  ASSERT_TRUE(encoder.detected.has_value());
  EXPECT_EQ(planned.plan.stages[*encoder.detected].kind, StageKind::position_loop);
  EXPECT_EQ(planned.plan.stages[*encoder.detected].step, 1);
  EXPECT_FALSE(encoder.evaluation.stable);
}

// The valve command that a rate takes is the inverse of the plant's response to it at rest.
TEST(TryFaults, TheValveCommandForARateIsThatOfTheStateSpace) {
  const auto& planned = reference::planned_stages();
  const TrackingProblem problem = tracking_problem(planned.mission);
  StageObserver observer(problem, problem.plant, WindTable(problem), planned.move);
  const double shown = observer.observe(planned.plan.stages.front().controller).valve_per_rate;
  const plant::StateSpace system = plant::to_state_space(problem.plant);
  const auto gain = plant::frequency_response(system, 1e-6)(
      plant::output_index(system, "tachometer"), plant::input_index(system, "valve_command"));
  EXPECT_NEAR(shown * std::abs(gain), 1.0, 1e-6);
}

// A valve of twice the gain is a rate loop of twice the gain.
TEST(TryFaults, AValveGainIsALoopGain) {
  const auto& planned = reference::planned_stages();
  const TrackingProblem problem = tracking_problem(planned.mission);
  const WindTable wind(problem);
  StageController stage = planned.plan.stages.front().controller;
  StageObserver faulty(problem, problem.plant, wind, planned.move, {.valve = 2.0});
  const auto seen = faulty.observe(stage);
  stage.controller.gains[0] *= 2.0;
  StageObserver stated(problem, problem.plant, wind, planned.move);
  const auto doubled = stated.observe(stage);
  EXPECT_NEAR(seen.crossover, doubled.crossover, 1e-9 * doubled.crossover);
  EXPECT_NEAR(seen.rise_time, doubled.rise_time, 1e-6 * doubled.rise_time);
  EXPECT_NEAR(seen.overshoot, doubled.overshoot, 1e-6);
  // The command behind the gain is half of it.
  EXPECT_NEAR(seen.calm.valve_command, 0.5 * doubled.calm.valve_command,
              1e-9 * doubled.calm.valve_command);
  EXPECT_TRUE(std::isnan(seen.peak));
  EXPECT_TRUE(std::isnan(seen.boresight_rms));
}

// Of four motors one turns at twice the speed for its oil: the rate takes an eighth less of it.
TEST(TryFaults, AMotorOfHalfItsDisplacementShowsInTheValveCommand) {
  const auto& planned = reference::fast_stages();
  const auto trials =
      try_faults(planned.mission, planned.plan, planned.move, usual_faults(4.0, true), {});
  const FaultTrial& trial = trial_of(trials, "one motor with half its displacement");
  ASSERT_TRUE(trial.detected.has_value());
  EXPECT_EQ(*trial.detected, 0U);
  const TrackingProblem problem = tracking_problem(planned.mission);
  StageObserver observer(problem, problem.plant, WindTable(problem), planned.move,
                         {.valve = 4.0 / 3.5, .torque = 4.0 / 3.5});
  const auto& stage = planned.plan.stages.front();
  const double shown = observer.observe(stage.controller).valve_per_rate;
  EXPECT_NEAR(shown, 3.5 / 4.0, 0.02);
  EXPECT_EQ(verdict_on(StageQuantity::valve_per_rate, shown, 0.0, stage, 1.2),
            StageVerdict::outside);
}

TEST(UsualFaults, OfOneMotorWithHalfItsDisplacement) {
  const auto faults = usual_faults(1.0, false);
  const auto motor =
      std::ranges::find(faults, "one motor with half its displacement", &AntennaFault::name);
  ASSERT_NE(motor, faults.end());
  // Of a single motor: a quarter of the stiffness, twice the speed for the same oil.
  EXPECT_DOUBLE_EQ(motor->changes.front().number, 0.25);
  EXPECT_DOUBLE_EQ(motor->factors.valve, 2.0);
  EXPECT_DOUBLE_EQ(motor->factors.torque, 2.0);
  EXPECT_EQ(std::ranges::find(faults, "torque with the wrong sign", &AntennaFault::name),
            faults.end());
  EXPECT_THROW(usual_faults(0.0, false), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
