#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

TunedLaw tuned_row(const std::string& structure, TunedFor purpose, double rms) {
  TunedLaw row;
  row.structure = structure;
  row.tuned_for = purpose;
  row.wind_speed = 10.0;
  row.beam_rms = rms * millidegree;
  row.goals_met = true;
  row.design.verification.passed = true;
  row.design.tuning.status = TuningStatus::optimal;
  row.design.tuning.law.structure = control::LoopStructure::named(structure);
  return row;
}

TuningStudy study_of(std::vector<TunedLaw> rows) {
  TuningStudy study;
  study.wind_speeds = {10.0};
  study.laws = std::move(rows);
  return study;
}

TEST(RecommendedLaw, IsTheRobustOneOfLeastSimulatedRms) {
  TuningStudy study =
      study_of({tuned_row("PI", TunedFor::robust, 0.50), tuned_row("FULL", TunedFor::robust, 0.40),
                tuned_row("FULL", TunedFor::nominal, 0.30)});
  EXPECT_EQ(best_law(study), &study.laws[1]);
  EXPECT_EQ(recommended_law(study), &study.laws[1]);
  // On the nonlinear antenna the other one points better.
  study.laws[0].in_time = LawInTime{.beam_rms = 0.45 * millidegree};
  study.laws[1].in_time = LawInTime{.beam_rms = 0.60 * millidegree};
  EXPECT_EQ(best_law(study), &study.laws[1]);
  EXPECT_EQ(recommended_law(study), &study.laws[0]);
}

TEST(RecommendedLaw, IsNoneWhereAllLimitCycle) {
  TuningStudy study = study_of({tuned_row("PI", TunedFor::robust, 0.50)});
  study.laws[0].in_time =
      LawInTime{.still = false, .hunting = 5.0 * millidegree, .beam_rms = 0.5 * millidegree};
  EXPECT_EQ(recommended_law(study), nullptr);
  EXPECT_TRUE(study.laws[0].left_out());
  const ControllerStudy alone{study, std::nullopt};
  ASSERT_NE(recommended_or(alone, Fitness::limit_cycle), nullptr);
  EXPECT_EQ(recommended_or(alone, Fitness::misses_member), nullptr);
}

// A tie in rms goes to fewer gains: 0.5 % does not pay for a notch and a lead.
TEST(RecommendedLaw, PrefersFewerGainsWithinTheTie) {
  const TuningStudy study = study_of(
      {tuned_row("FULL", TunedFor::robust, 0.400), tuned_row("PI", TunedFor::robust, 0.402)});
  EXPECT_EQ(recommended_law(study), &study.laws[1]);
}

TEST(TunedLaw, KeepsABudgetByTheLargerRmsAndByItsLimitCycle) {
  TunedLaw row = tuned_row("PI", TunedFor::robust, 0.40);
  EXPECT_TRUE(row.keeps(0.41 * millidegree));
  row.in_time = LawInTime{.beam_rms = 0.45 * millidegree};
  EXPECT_FALSE(row.keeps(0.41 * millidegree));
  EXPECT_TRUE(row.keeps(0.46 * millidegree));
  row.in_time->still = false;
  row.in_time->hunting = 10.0 * millidegree;
  EXPECT_FALSE(row.keeps(0.46 * millidegree));
  row.in_time->beam_rms = std::numeric_limits<double>::quiet_NaN();
  row.in_time->still = true;
  EXPECT_FALSE(row.keeps(0.46 * millidegree));
}

TEST(TunedLaw, AddsTheLimitCycleInQuadrature) {
  TunedLaw row = tuned_row("PI", TunedFor::robust, 0.39);
  row.in_time = LawInTime{.hunting = 0.34 * millidegree, .beam_rms = 0.40 * millidegree};
  EXPECT_NEAR(row.budget_rms() / millidegree, 0.4666905, 1e-6);
  EXPECT_TRUE(row.keeps(0.467 * millidegree));
  EXPECT_FALSE(row.keeps(0.466 * millidegree));
  // Though neither the rms nor the limit cycle alone breaks it.
  EXPECT_LE(row.in_time->hunting, hunting_limit(0.466 * millidegree));
  row.in_time->hunting_seen = false;
  EXPECT_FALSE(row.keeps(millidegree));
}

TEST(TuneStructures, IsTheSameForAnyNumberOfThreadsAndNamesWhatAnInterruptLeftOut) {
  Mission mission = reference::demo_mission();
  mission.structures = {{"PI", control::LoopStructure::named("PI")}};
  mission.starts = 2;
  const PlantEnsemble ensemble{EnsembleSource::ranges,
                               {{"nominal", linear_plant(mission.antenna)}}};
  TuneOptions options;
  const TuningStudy one = tune_structures(mission, ensemble, options);
  options.threads = 2;
  const TuningStudy two = tune_structures(mission, ensemble, options);
  ASSERT_EQ(one.laws.size(), 2U);
  ASSERT_TRUE(one.laws[1].stable());
  EXPECT_EQ(one.laws[1].design.tuning.law.gains, two.laws[1].design.tuning.law.gains);
  EXPECT_EQ(one.laws[1].beam_rms, two.laws[1].beam_rms);
  options.interrupted = [] { return true; };
  const TuningStudy none = tune_structures(mission, ensemble, options);
  EXPECT_TRUE(none.laws.empty());
  ASSERT_EQ(none.not_run.size(), 2U);
  EXPECT_EQ(none.not_run[0].structure, "PI");
  options.interrupted = {};
  options.wind_speeds = {100.0};
  EXPECT_THROW(tune_structures(mission, ensemble, options), InvalidInput);
}

// What the study recommends is what ran on the nonlinear antenna, and its own gains.
TEST(StudyControllers, RunsWhatItRecommendsOnTheNonlinearAntenna) {
  Mission mission = reference::demo_mission();
  mission.structures = {{"PI", control::LoopStructure::named("PI")}};
  mission.starts = 2;
  const PlantEnsemble ensemble{EnsembleSource::ranges,
                               {{"nominal", linear_plant(mission.antenna)}}};
  const ControllerStudy study = study_controllers(mission, ensemble, {});
  const TunedLaw* best = recommended_or(study, Fitness::limit_cycle);
  ASSERT_NE(best, nullptr);
  ASSERT_TRUE(study.time_domain.has_value());
  const auto run = run_of(*study.time_domain, *best);
  ASSERT_TRUE(run.has_value());
  ASSERT_TRUE(best->in_time.has_value());
  EXPECT_EQ(best->in_time->beam_rms, run->result.wind.beam_rms);
  ASSERT_TRUE(best->in_time->expected.has_value());
  EXPECT_EQ(best->in_time->expected->records, 10);
  EXPECT_EQ(best->in_time->rms(), best->in_time->expected->rms.value);
  EXPECT_EQ(shown_law(study.tuned, &*study.time_domain), best);
  mission.antenna.nonlinear.reset();
  EXPECT_FALSE(study_controllers(mission, ensemble, {}).time_domain.has_value());
}

}  // namespace
}  // namespace boresight::design
