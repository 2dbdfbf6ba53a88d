#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/planned_stages.hpp"
#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/commissioning/commissioning_trials.hpp>
#include <boresight/design/commissioning/plant_update.hpp>
#include <boresight/design/commissioning/stage_record.hpp>
#include <boresight/design/commissioning/stage_simulation.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

// The stages to pressure feedback on the demo antenna, with their experiments.
struct Experiments {
  const reference::PlannedStages& planned;
  double gear = plant::gear_ratio(planned.mission.antenna);
  CommissioningPlan plan = planned.plan;
  std::vector<StageExperiment> experiments;

  explicit Experiments(const reference::PlannedStages& of_plan) : planned(of_plan) {
    for (CommissioningStage& stage : plan.stages) {
      const double step =
          stage.controller.position_open ? 10.0 * millidegree * gear : 20.0 * millidegree * gear;
      experiments.push_back(stage_experiment(planned.mission, stage, step, planned.move));
      stage.flow = flow_model(planned.mission);
      stage.effects = experiment_effects(planned.mission, stage, experiments.back());
    }
  }

  StageMeasurement measure(std::size_t stage, const StageSimulationOptions& options) const {
    return measure_stage(
        simulate_stage(planned.mission, plan.stages[stage], experiments[stage], options),
        plan.stages[stage], gear);
  }
};

const Experiments& prepared() {
  static const Experiments experiments(reference::fast_stages());
  return experiments;
}

std::string in_words(const std::vector<EvaluatedQuantity>& quantities) {
  std::string text;
  for (const auto& one : quantities) {
    if (one.verdict == StageVerdict::passes) continue;
    text += std::string(to_string(one.measured.quantity)) + " " +
            std::to_string(one.measured.value) + " +- " + std::to_string(one.measured.uncertainty) +
            ", " + std::to_string(one.expected.lower) + " to " +
            std::to_string(one.expected.upper) + "; ";
  }
  return text;
}

// Friction, orifices, backlash, encoder counts and noise are in the record; the friction is not
// quite that of the case.
TEST(SimulateStage, OfTheAntennaAsStatedPassesEveryStage) {
  const Experiments& stages = prepared();
  std::size_t quantities = 0;
  for (const auto& [friction, seed] :
       {std::pair{1.0, 1U}, std::pair{0.75, 2U}, std::pair{1.25, 3U}}) {
    for (std::size_t i = 0; i < stages.plan.stages.size(); ++i) {
      for (const auto part : {ExperimentPart::command, ExperimentPart::still_air}) {
        StageSimulationOptions options;
        options.part = part;
        options.friction = friction;
        options.seed = seed;
        const auto shown = evaluated(stages.measure(i, options), stages.plan.stages[i], 1.2);
        EXPECT_GE(shown.size(), 2U) << i;
        quantities += shown.size();
        EXPECT_EQ(worst_verdict(shown), StageVerdict::passes)
            << "stage " << i + 1 << ", friction x " << friction << ": " << in_words(shown);
      }
    }
  }
  EXPECT_GE(quantities, 18 * stages.plan.stages.size());
}

// It replaces the gains as a whole, so that its stages have moves alone.
TEST(SimulateStage, OfAStateSpacePassesItsMoves) {
  const control::Controller loops{control::LoopStructure::named("FULL+L"),
                                  {0.8, 7.0, 40.0, 0.1, 30.0, 0.4, 1.0, 10.0}};
  const reference::PlannedStages planned(control::state_space_controller(
      "of loops", plant::subsystem(control::sampled_controller(loops, 0.02),
                                   {"tachometer", "encoder", "motor_torque"}, {"valve_demand"})));
  const Experiments stages(planned);
  ASSERT_GE(stages.plan.stages.size(), 2U);
  for (std::size_t i = 0; i < stages.plan.stages.size(); ++i) {
    ASSERT_TRUE(stages.plan.stages[i].controller.feedforward);
    for (const double friction : {0.8, 1.2}) {
      StageSimulationOptions options;
      options.friction = friction;
      const auto shown = evaluated(stages.measure(i, options), stages.plan.stages[i], 1.2);
      EXPECT_GE(shown.size(), 2U) << i;
      EXPECT_EQ(worst_verdict(shown), StageVerdict::passes)
          << "stage " << i + 1 << ", friction x " << friction << ": " << in_words(shown);
    }
  }
}

// What made the brackets of the linear plants useless for a record: friction and orifices slow the
// rate loop by a quarter and more.
TEST(SimulateStage, DiffersFromTheLinearPlant) {
  const Experiments& stages = prepared();
  CommissioningStage linear = stages.plan.stages.front();
  linear.effects.clear();
  const auto shown = evaluated(stages.measure(0, {}), linear, 1.2);
  EXPECT_EQ(worst_verdict(shown), StageVerdict::outside);
  EXPECT_THAT(in_words(shown), testing::HasSubstr("rise time"));
}

TEST(SimulateStage, AWrongAntennaIsDetectedByItsRecord) {
  const Experiments& stages = prepared();
  const auto trials = try_faults(stages.planned.mission, stages.plan, stages.planned.move,
                                 usual_faults(4.0, true), {}, stages.experiments);
  const auto detected = [&](const std::string& fault) {
    const auto found = std::ranges::find(trials, fault, &FaultTrial::fault);
    EXPECT_NE(found, trials.end()) << fault;
    return *found;
  };
  const FaultTrial oil = detected("oil stiffness halved");
  EXPECT_EQ(oil.detected, 0U);
  EXPECT_EQ(oil.evaluation.worst, StageQuantity::oil_stiffness);
  EXPECT_NEAR(oil.measured,
              0.5 * tracking_problem(stages.planned.mission).plant.drive.oil_stiffness,
              0.25 * oil.measured);
  const FaultTrial motor = detected("one motor with half its displacement");
  EXPECT_EQ(motor.detected, 0U);
  EXPECT_THAT(motor.evaluation.outside, testing::Contains(StageQuantity::flow_per_rate));
  EXPECT_FALSE(detected("tachometer with the wrong sign").evaluation.stable);
  EXPECT_EQ(detected("tachometer with the wrong sign").detected, 0U);
  for (const char* fault : {"oil stiffness doubled", "valve gain halved", "valve gain doubled",
                            "tachometer scale halved", "tachometer scale doubled",
                            "encoder with the wrong sign", "torque with the wrong sign"}) {
    EXPECT_TRUE(detected(fault).detected.has_value()) << fault;
  }
}

// At rest stiction holds the antenna within one encoder step.
TEST(SimulateStage, IsOnAMotionThatDoesNotReverse) {
  const Experiments& stages = prepared();
  for (std::size_t i = 0; i < stages.plan.stages.size(); ++i) {
    StageSimulationOptions options;
    options.noise = false;
    const auto record = simulate_stage(stages.planned.mission, stages.plan.stages[i],
                                       stages.experiments[i], options);
    EXPECT_GT(record.motor_rate->values.tail(record.motor_rate->values.size() / 2).minCoeff(), 0.0)
        << i;
  }
}

// The record of the antenna as stated does not make the uncertainty set contradict itself.
TEST(UpdatedPlants, ExplainTheRecordOfTheNonlinearAntenna) {
  const Experiments& stages = prepared();
  std::vector<MeasuredStage> records;
  for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
    records.push_back({i, stages.measure(i, {})});
  }
  const auto faults = usual_faults(4.0, true);
  const auto update = updated_plants(stages.planned.mission, stages.planned.distribution,
                                     stages.plan, stages.planned.move, records, faults, 100, {});
  EXPECT_TRUE(update.explained) << update.mismatch;
  StageSimulationOptions half;
  half.changes = faults.front().changes;
  const auto wrong =
      updated_plants(stages.planned.mission, stages.planned.distribution, stages.plan,
                     stages.planned.move, {{0, stages.measure(0, half)}}, faults, 100, {});
  EXPECT_FALSE(wrong.explained) << wrong.mismatch;
}

}  // namespace
}  // namespace boresight::design
