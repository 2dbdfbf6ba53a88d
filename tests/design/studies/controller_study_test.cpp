#include <algorithm>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include "lag_loops.hpp"
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

TunedController tuned_row(const std::string& structure, TunedFor purpose, double rms) {
  TunedController row;
  row.structure = structure;
  row.tuned_for = purpose;
  row.wind_speed = 10.0;
  row.boresight_rms = rms * millidegree;
  row.constraints_met = true;
  row.design.verification.passed = true;
  row.design.tuning.status = TuningStatus::optimal;
  row.design.tuning.controller.structure = control::LoopStructure::named(structure);
  return row;
}

// The demo mission with one structure and few starts.
Mission mission_of(const std::string& structure) {
  Mission mission = reference::demo_mission();
  mission.structures.loops = {{structure, control::LoopStructure::named(structure)}};
  mission.starts = 2;
  return mission;
}

PlantEnsemble nominal_ensemble(const Mission& mission) {
  return {EnsembleSource::ranges, {{"nominal", linear_plant(mission.antenna)}}};
}

TuningStudy study_of(std::vector<TunedController> rows) {
  TuningStudy study;
  study.wind_speeds = {10.0};
  study.controllers = std::move(rows);
  return study;
}

TEST(RecommendedController, IsTheRobustOneOfLeastSimulatedRms) {
  TuningStudy study =
      study_of({tuned_row("PI", TunedFor::robust, 0.50), tuned_row("FULL", TunedFor::robust, 0.40),
                tuned_row("FULL", TunedFor::nominal, 0.30)});
  EXPECT_EQ(best_controller(study), &study.controllers[1]);
  EXPECT_EQ(recommended_tuned_controller(study), &study.controllers[1]);
  // On the nonlinear antenna the other one points better.
  study.controllers[0].in_time = ControllerInTime{.boresight_rms = 0.45 * millidegree};
  study.controllers[1].in_time = ControllerInTime{.boresight_rms = 0.60 * millidegree};
  EXPECT_EQ(best_controller(study), &study.controllers[1]);
  EXPECT_EQ(recommended_tuned_controller(study), &study.controllers[0]);
}

TEST(RecommendedController, IsNoneWhereAllLimitCycle) {
  TuningStudy study = study_of({tuned_row("PI", TunedFor::robust, 0.50)});
  study.controllers[0].in_time = ControllerInTime{.limit_cycle_free = false,
                                                  .limit_cycles = 5.0 * millidegree,
                                                  .boresight_rms = 0.5 * millidegree};
  EXPECT_EQ(recommended_tuned_controller(study), nullptr);
  EXPECT_TRUE(study.controllers[0].left_out());
  const ControllerStudy alone{study, std::nullopt};
  ASSERT_NE(recommended_or(alone, Fitness::limit_cycle), nullptr);
  EXPECT_EQ(recommended_or(alone, Fitness::misses_member), nullptr);
}

// A tie in rms goes to fewer gains: 0.5 % does not pay for a notch and a lead.
TEST(RecommendedController, PrefersFewerGainsWithinTheTie) {
  const TuningStudy study = study_of(
      {tuned_row("FULL", TunedFor::robust, 0.400), tuned_row("PI", TunedFor::robust, 0.402)});
  EXPECT_EQ(recommended_tuned_controller(study), &study.controllers[1]);
}

TEST(TunedController, KeepsABudgetByTheLargerRmsAndByItsLimitCycle) {
  TunedController row = tuned_row("PI", TunedFor::robust, 0.40);
  EXPECT_TRUE(row.keeps(0.41 * millidegree));
  row.in_time = ControllerInTime{.boresight_rms = 0.45 * millidegree};
  EXPECT_FALSE(row.keeps(0.41 * millidegree));
  EXPECT_TRUE(row.keeps(0.46 * millidegree));
  row.in_time->limit_cycle_free = false;
  row.in_time->limit_cycles = 10.0 * millidegree;
  EXPECT_FALSE(row.keeps(0.46 * millidegree));
  row.in_time->boresight_rms = std::numeric_limits<double>::quiet_NaN();
  row.in_time->limit_cycle_free = true;
  EXPECT_FALSE(row.keeps(0.46 * millidegree));
}

TEST(TunedController, AddsTheLimitCycleInQuadrature) {
  TunedController row = tuned_row("PI", TunedFor::robust, 0.39);
  row.in_time =
      ControllerInTime{.limit_cycles = 0.34 * millidegree, .boresight_rms = 0.40 * millidegree};
  EXPECT_NEAR(row.budget_rms() / millidegree, 0.4666905, 1e-6);
  EXPECT_TRUE(row.keeps(0.467 * millidegree));
  EXPECT_FALSE(row.keeps(0.466 * millidegree));
  // Though neither the rms nor the limit cycle alone breaks it.
  Mission mission;
  mission.budgets.resize(1);
  mission.budgets[0].rms = 0.466 * millidegree;
  EXPECT_LE(row.in_time->limit_cycles, allowed_limit_cycle(mission));
  row.in_time->limit_cycle_runs_complete = false;
  EXPECT_FALSE(row.keeps(millidegree));
}

TEST(TuneStructures, IsTheSameForAnyNumberOfThreadsAndNamesWhatAnInterruptLeftOut) {
  Mission mission = mission_of("PI");
  const PlantEnsemble ensemble = nominal_ensemble(mission);
  TuneOptions options;
  const TuningStudy one = tune_structures(mission, ensemble, options);
  options.threads = 2;
  const TuningStudy two = tune_structures(mission, ensemble, options);
  ASSERT_EQ(one.controllers.size(), 2U);
  ASSERT_TRUE(one.controllers[1].stable());
  EXPECT_EQ(one.controllers[1].design.tuning.controller.gains,
            two.controllers[1].design.tuning.controller.gains);
  EXPECT_EQ(one.controllers[1].boresight_rms, two.controllers[1].boresight_rms);
  options.interrupted = [] { return true; };
  const TuningStudy none = tune_structures(mission, ensemble, options);
  EXPECT_TRUE(none.controllers.empty());
  ASSERT_EQ(none.not_run.size(), 2U);
  EXPECT_EQ(none.not_run[0].structure, "PI");
  options.interrupted = {};
  options.wind_speeds = {100.0};
  EXPECT_THROW(tune_structures(mission, ensemble, options), InvalidInput);
}

// What the study recommends is what ran on the nonlinear antenna, and its own gains.
TEST(StudyControllers, RunsWhatItRecommendsOnTheNonlinearAntenna) {
  Mission mission = mission_of("PI");
  const PlantEnsemble ensemble = nominal_ensemble(mission);
  const ControllerStudy study = study_controllers(mission, ensemble, {});
  const TunedController* best = recommended_or(study, Fitness::limit_cycle);
  ASSERT_NE(best, nullptr);
  ASSERT_TRUE(study.time_domain.has_value());
  const auto run = run_of(*study.time_domain, *best);
  ASSERT_TRUE(run.has_value());
  ASSERT_TRUE(best->in_time.has_value());
  EXPECT_EQ(best->in_time->boresight_rms, run->result.wind.boresight_rms);
  ASSERT_TRUE(best->in_time->expected.has_value());
  EXPECT_EQ(best->in_time->expected->records, 10);
  EXPECT_EQ(best->in_time->rms(), best->in_time->expected->rms.value);
  EXPECT_EQ(shown_controller(study.tuned, &*study.time_domain), best);
  mission.antenna.nonlinear.reset();
  EXPECT_FALSE(study_controllers(mission, ensemble, {}).time_domain.has_value());
}

// Beside a state space: the best loops, though none of them would be recommended.
TEST(RecommendedLoops, AreTheLeastUnfitWithoutTheStateSpace) {
  TuningStudy study =
      study_of({tuned_row("PI", TunedFor::robust, 0.5), tuned_row("FULL", TunedFor::robust, 0.4),
                tuned_row("LL", TunedFor::robust, 0.2)});
  for (std::size_t i = 0; i < 2; ++i) {
    study.controllers[i].in_time =
        ControllerInTime{.limit_cycle_free = false,
                         .limit_cycles = millidegree,
                         .boresight_rms = study.controllers[i].boresight_rms};
  }
  TunedController& states = study.controllers[2];
  states.structure = "SS";
  states.design.tuning.controller.structure = reference::lag_loops_as_state_space().structure;
  states.in_time = ControllerInTime{.boresight_rms = 0.2 * millidegree};
  EXPECT_EQ(recommended_tuned_controller(study, 10.0), &states);
  EXPECT_EQ(recommended_loops(study, 10.0), &study.controllers[1]);
  EXPECT_EQ(recommended_loops(study, 12.0), nullptr);
}

// A state space is compared with the loops only where it is asked for; then it starts from them,
// and the choice is that of recommend() among all.
TEST(StudyControllers, ComparesAStateSpaceWhereTheStructuresAskForOne) {
  Mission mission = mission_of("LL+L");
  const PlantEnsemble ensemble = nominal_ensemble(mission);
  const ControllerStudy loops = study_controllers(mission, ensemble, {});
  EXPECT_FALSE(loops.limit);
  mission.structures.state_space = true;
  TuneOptions options;
  options.threads = 2;
  const ControllerStudy study = study_controllers(mission, ensemble, options);
  EXPECT_THAT(study.tuned.structures, testing::ElementsAre("LL+L", "SS"));
  ASSERT_TRUE(study.limit);
  ASSERT_TRUE(study.limit->refined);
  ASSERT_EQ(study.tuned.controllers.size(), loops.tuned.controllers.size() + 1);
  const TunedController& found = study.tuned.controllers.back();
  ASSERT_TRUE(found.is_state_space());
  EXPECT_TRUE(found.usable()) << found.design.verification.failure;
  ASSERT_TRUE(study.time_domain);
  ASSERT_TRUE(run_of(*study.time_domain, found));
  ASSERT_TRUE(found.in_time);
  EXPECT_EQ(found.in_time->rms(), run_of(*study.time_domain, found)->simulated_rms());
  EXPECT_NEAR(found.boresight_rms / study.limit->refined->nominal.boresight_rms, 1.0, 2e-2);
  // The loops are the same as without it, and would be recommended without it.
  const TunedController* of_loops = recommended_loops(study.tuned, found.wind_speed);
  const TunedController* alone = recommended_tuned_controller(loops.tuned);
  ASSERT_TRUE(of_loops != nullptr && alone != nullptr);
  EXPECT_EQ(of_loops->design.tuning.controller.gains, alone->design.tuning.controller.gains);
  const TunedController* recommended = recommended_tuned_controller(study.tuned);
  ASSERT_NE(recommended, nullptr);
  const Assessment one = assessment_of(study.tuned, found);
  const Assessment other = assessment_of(study.tuned, *of_loops);
  const Assessment& least = ranking_figure(one) < ranking_figure(other) ? one : other;
  EXPECT_TRUE(are_tied(assessment_of(study.tuned, *recommended), least, 0.02));
  EXPECT_EQ(study.time_domain->controller, description_of(*recommended));
}

}  // namespace
}  // namespace boresight::design
