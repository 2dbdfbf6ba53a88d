#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/simulated_errors.hpp"
#include "design/studies/demo_mission.hpp"
#include "design/studies/fixed_controller.hpp"
#include <boresight/design/commissioning/commissioning_check.hpp>
#include <boresight/design/studies/change_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using identification::ServoRecord;
using identification::Signal;
using testing::HasSubstr;

control::Controller controller(double factor) {
  control::Controller result = reference::fixed_controller("PI", 1.0).design.tuning.controller;
  result.gains[3] *= factor;  // of the position path
  return result;
}

Mission mission_of_test() {
  Mission mission = reference::uncertain_mission();
  mission.uncertainty.random_samples = 2;
  return mission;
}

// Six records with each controller, at 5 to 10 and 7 to 12 m/s.
struct Setting {
  explicit Setting(double factor_before = 0.5, double factor_after = 1.0)
      : before(controller(factor_before)), after(controller(factor_after)) {
    const TrackingProblem problem = tracking_problem(mission);
    reference::SimulatedErrors with_before(before, problem), with_after(after, problem);
    for (int i = 0; i < 6; ++i) {
      const auto seed = static_cast<std::uint64_t>(i);
      records.before.push_back(with_before.record(5.0 + i, 1 + seed));
      records.after.push_back(with_after.record(7.0 + i, 101 + seed));
    }
  }
  ChangeStudy study(unsigned threads = 1) const {
    return study_change(mission, ensemble, records, before, after, {.threads = threads});
  }

  Mission mission = mission_of_test();
  control::Controller before, after;
  PlantEnsemble ensemble{EnsembleSource::ranges, plant_members(mission, 1)};
  ChangeRecords records;
};

std::optional<bool> check(const ChangeStudy& study, ChangeCheckKind kind) {
  for (const ChangeCheck& one : study.checks) {
    if (one.kind == kind) return one.passed;
  }
  ADD_FAILURE() << "no such check";
  return std::nullopt;
}

TEST(StudyChange, FindsThePredictedImprovement) {
  const Setting setting;
  const ChangeStudy study = setting.study();
  ASSERT_TRUE(study.predicted && study.comparison.at_reference);
  EXPECT_LT(study.predicted->ratio.value, 1.0);
  EXPECT_LE(study.predicted->ratio.lower, study.predicted->ratio.value);
  EXPECT_GE(study.predicted->ratio.upper, study.predicted->ratio.value);
  EXPECT_EQ(study.predicted->plants, setting.ensemble.members.size());
  EXPECT_TRUE(study.predicted->held);
  EXPECT_EQ(study.stable_plants, study.plants);
  EXPECT_EQ(check(study, ChangeCheckKind::wind_overlap), true);
  EXPECT_EQ(check(study, ChangeCheckKind::stability), true);
  EXPECT_EQ(check(study, ChangeCheckKind::prediction), true);
  EXPECT_EQ(check(study, ChangeCheckKind::wind_direction), std::nullopt);
}

TEST(StudyChange, DoesNotDependOnThreads) {
  const Setting setting;
  const ChangeStudy one = setting.study(1);
  const ChangeStudy two = setting.study(2);
  EXPECT_EQ(one.predicted->ratio.lower, two.predicted->ratio.lower);
  EXPECT_EQ(one.comparison.at_reference->ratio.value, two.comparison.at_reference->ratio.value);
}

TEST(StudyChange, FindsAPredictionThatDoesNotHold) {
  Setting setting;
  // What was entered is not what ran.
  for (WindyRecord& record : setting.records.after) record.error.values *= 4.0;
  const ChangeStudy study = setting.study();
  EXPECT_FALSE(study.predicted->held);
  EXPECT_EQ(check(study, ChangeCheckKind::prediction), false);
  EXPECT_EQ(check(study, ChangeCheckKind::improvement), false);
}

TEST(StudyChange, PredictsNothingWithoutTheControllerBefore) {
  const Setting setting;
  const ChangeStudy study =
      study_change(setting.mission, setting.ensemble, setting.records, std::nullopt, setting.after);
  EXPECT_FALSE(study.predicted);
  EXPECT_EQ(check(study, ChangeCheckKind::prediction), std::nullopt);
  EXPECT_EQ(check(study, ChangeCheckKind::stability), true);
}

TEST(PredictedRms, IsThatOfTheLoopEvaluatorAndTheStageObserver) {
  const Setting setting;
  TrackingProblem problem = tracking_problem(setting.mission);
  problem.noise = {0.1 * reference::mdeg * problem.gear_ratio, 0.02, 25.0};
  problem.rms_band = {0.02, 5.0};
  const auto evaluation = make_evaluator(problem).evaluate(setting.after, false);
  const double boresight = std::sqrt(evaluation.boresight_variance()) / problem.gear_ratio;
  EXPECT_NEAR(predicted_rms(problem, setting.after, RecordedError::boresight, 10.0, {0.02, 5.0}),
              boresight, 2e-3 * boresight);
  StageObserver observer(problem, problem.plant, WindTable(problem), {0.1, 0.1});
  const double encoder = observer.observe({setting.after}).windy.encoder_error / problem.gear_ratio;
  EXPECT_NEAR(predicted_rms(problem, setting.after, RecordedError::position, 10.0, {1e-4, 25.0}),
              encoder, 0.01 * encoder);
}

TEST(ChangeRecords, TakesTheErrorThatAllRecordsHave) {
  const Signal signal{Eigen::VectorXd::Ones(300), {}};
  ServoRecord both;
  both.name = "both";
  both.sample_time = 0.1;
  both.position_error = both.boresight_error = both.wind_speed = signal;
  ServoRecord position = both;
  position.name = "position";
  position.boresight_error.reset();
  EXPECT_EQ(change_records({both}, {both}).error, RecordedError::boresight);
  const ChangeRecords mixed = change_records({both}, {position}, 1.5);
  EXPECT_EQ(mixed.error, RecordedError::position);
  EXPECT_EQ(mixed.after.front().wind_speed.values[0], 1.5);
  const auto refusal = [&](const ServoRecord& record) -> std::string {
    try {
      change_records({both}, {record});
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  position.position_error.reset();
  EXPECT_THAT(refusal(position), HasSubstr("position: expected a column of the position error"));
  ServoRecord calm = both;
  calm.wind_speed.reset();
  EXPECT_THAT(refusal(calm), HasSubstr("expected a column of the wind speed"));
}

}  // namespace
}  // namespace boresight::design
