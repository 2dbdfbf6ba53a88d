#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/planned_stages.hpp"
#include <boresight/design/studies/stage_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

CommissionStudy planned_study() {
  const auto& planned = reference::planned_stages();
  CommissionStudy study;
  study.problem = tracking_problem(planned.mission);
  study.move = planned.move;
  study.plan = planned.plan;
  return study;
}

// Noise of the valve's expected rms at rest.
StageRecord still_air(std::size_t stage, double factor) {
  const auto& of_plan = reference::planned_stages().plan.stages[stage];
  StageRecord record{stage, {}};
  record.record.name = "still";
  record.record.sample_time = 0.02;
  Eigen::VectorXd valve(2000);
  std::mt19937 numbers(3);
  std::normal_distribution<double> normal;
  for (double& value : valve) value = normal(numbers);
  record.record.valve_command =
      identification::Signal{factor * of_plan.expected.calm_valve.nominal * valve, {}};
  return record;
}

StageStudy stages_of(const StageStudyOptions& options) {
  const auto& planned = reference::planned_stages();
  return study_stages(planned.mission, planned.distribution, planned_study(), options);
}

TEST(StudyStages, TriesFaultsAlwaysAndFreshPlantsWhereAsked) {
  StageStudyOptions options;
  options.motors = 4.0;
  const StageStudy without = stages_of(options);
  EXPECT_EQ(without.faults.size(), usual_faults(4.0, false).size());
  EXPECT_TRUE(without.trials.stages.empty());
  EXPECT_FALSE(without.update.has_value());
  options.fresh_plants = 10;
  EXPECT_EQ(stages_of(options).trials.plants, 10U);
}

TEST(StudyStages, EvaluatesEveryRecordAndUpdatesThePlants) {
  StageStudyOptions options;
  options.records = {still_air(0, 1.0), still_air(0, 3.0)};
  const StageStudy study = stages_of(options);
  ASSERT_EQ(study.records.size(), 2U);
  EXPECT_EQ(worst_verdict(study.records[0].evaluated), StageVerdict::passes);
  EXPECT_EQ(worst_verdict(study.records[1].evaluated), StageVerdict::abort);
  ASSERT_TRUE(study.update.has_value());
  EXPECT_EQ(study.update->quantities, 1U);  // of one stage, in one
}

TEST(StudyStages, RefusesARecordOfAStageThatThePlanDoesNotHave) {
  StageStudyOptions options;
  options.records = {still_air(0, 1.0)};
  options.records.front().stage = reference::planned_stages().plan.stages.size();
  EXPECT_THROW(stages_of(options), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
