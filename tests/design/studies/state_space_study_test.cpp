#include <cmath>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include "design/verification/demo_loop.hpp"
#include "lag_loops.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/studies/pointing_evaluation.hpp>
#include <boresight/design/studies/state_space_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

// As a benchmark: no search, but loops as a state space, which must do what the loops do.
PointingLimit limit_of(const TrackingProblem& problem, const control::Controller& controller) {
  const double sample_time = problem.delay / 1.5;
  PointingLimit limit;
  limit.refined.emplace();
  limit.refined->controller =
      plant::renamed(plant::subsystem(control::sampled_controller(controller, sample_time),
                                      {"tachometer", "encoder"}, {"valve_demand"}),
                     {{"valve_demand", "valve_command"}});
  return limit;
}

TEST(StateSpaceStudy, SeesLoopsAsAStateSpaceAsTheLoopsThemselves) {
  const Mission mission = reference::demo_mission();
  const TrackingProblem problem = tracking_problem(mission);
  const control::Controller loops = reference::lag_loops();
  const auto simulated =
      verify_in_time_domain(mission, problem, loops, "LL+L", 1, 2, FurtherRuns::none);
  ASSERT_TRUE(simulated);
  const auto study = study_state_space(mission, problem, limit_of(problem, loops), *simulated, 2);
  ASSERT_TRUE(study);
  EXPECT_EQ(study->wind_speed, problem.wind.mean_speed);
  EXPECT_EQ(study->simulated.controller, "state space, order 2");
  EXPECT_NEAR(study->simulated.simulated_rms() / simulated->own().simulated_rms(), 1.0, 1e-4);
  EXPECT_NEAR(study->simulated.result.wind.static_error / simulated->result.wind.static_error, 1.0,
              1e-5);
  ASSERT_TRUE(study->change);
  EXPECT_NEAR(study->change->value, 0.0, 1e-4);
  ASSERT_TRUE(study->simulated.result.slew);
  EXPECT_EQ(study->limit_cycle_free,
            is_limit_cycle_free(simulated->result.limit_cycles, allowed_limit_cycle(mission)));
}

// An integral, friction and encoder steps: a limit cycle with the stated friction, which decides.
TEST(LimitCycleViolations, AreThoseOfTheStatedFrictionFirst) {
  const reference::DemoLoop demo;
  const auto as_state_space = [&](const control::Controller& loops) {
    return limit_of(demo.problem, loops).refined->controller;
  };
  const plant::StateSpace integral = as_state_space(demo.loop.controller);
  const auto violations = [&](const plant::StateSpace& controller, int enough) {
    return limit_cycle_violations(demo.mission, demo.problem, controller, enough, 2);
  };
  const auto simulated = verify_in_time_domain(demo.mission, demo.problem, demo.loop.controller,
                                               "PI", 1, 2, FurtherRuns::none);
  ASSERT_TRUE(simulated);
  int starts = 0;
  for (const LimitCycleResult& one : simulated->result.limit_cycles) {
    starts += one.starts_with_limit_cycle;
  }
  ASSERT_GT(starts, 1);
  EXPECT_EQ(violations(integral, 1000), 30);  // however many
  EXPECT_EQ(violations(integral, 1), 1);
  EXPECT_EQ(violations(as_state_space(reference::lag_loops()), 1000), 0);
}

// With a slower integral there is none with the stated friction, but with other friction.
TEST(LimitCycleViolations, AreThoseOfOtherFrictionWhereTheStatedHasNone) {
  reference::DemoLoop demo;
  demo.loop.controller.gains[4] *= 0.25;
  demo.loop.encoder_resolution = std::sqrt(12.0) * demo.problem.noise.encoder_rms;
  NonlinearVerificationOptions options;
  options.tracking_rate = demo.mission.antenna.drive.tracking_rate;
  options.limits = {demo.mission.antenna.drive.slew_rate, 0.2 * degree};
  options.threads = 2;
  int expected = 0;
  for (const LimitCyclesWithFriction& one : limit_cycles_by_friction(
           demo.loop, friction_variations(demo.loop.antenna.friction), options)) {
    expected += one.limit_cycles;
  }
  ASSERT_GT(expected, 1);
  const auto controller = limit_of(demo.problem, demo.loop.controller).refined->controller;
  const auto violations = [&](int enough) {
    return limit_cycle_violations(demo.mission, demo.problem, controller, enough, 2);
  };
  EXPECT_EQ(violations(1000), expected);
  EXPECT_EQ(violations(1), 1);
}

// Loops as a state space are assessed as the loops are, but for what has no place in it: the rate
// loop and the position loop.
TEST(StateSpaceCandidate, IsAssessedAsTheLoopsAre) {
  const Mission mission = reference::demo_mission();
  const TrackingProblem problem = tracking_problem(mission);
  const control::Controller loops = reference::lag_loops();
  PlantEnsemble ensemble{EnsembleSource::ranges, {{"nominal", problem.plant}}};
  ensemble.members.push_back({"stiff", problem.plant});
  ensemble.members.back().plant.drive.oil_stiffness *= 1.2;
  TuningStudy study;
  study.goals = constraints(mission);
  TunedController expected;
  expected.tuned_for = TunedFor::robust;
  expected.wind_speed = 10.0;
  expected.design = assess(problem, loops, study.goals);
  evaluate_pointing(mission, ensemble, study, expected);

  const auto found =
      state_space_candidate(mission, ensemble, study, limit_of(problem, loops), 10.0);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_state_space());
  EXPECT_EQ(found->structure, "SS");
  EXPECT_EQ(found->tuned_for, TunedFor::robust);
  EXPECT_TRUE(found->stable());
  EXPECT_NEAR(found->boresight_rms / expected.boresight_rms, 1.0, 1e-3);
  ASSERT_TRUE(found->ensemble && expected.ensemble);
  for (std::size_t i = 0; i < ensemble.members.size(); ++i) {
    const MemberResult &one = found->ensemble->members[i], &other = expected.ensemble->members[i];
    EXPECT_TRUE(one.stable);
    EXPECT_NEAR(one.boresight_rms / other.boresight_rms, 1.0, 1e-3);
    EXPECT_NEAR(one.sensitivity_peaks[1] / other.sensitivity_peaks[1], 1.0, 2e-2);
  }
  EXPECT_GE(found->design.tuning.worst_constraint,
            found->ensemble->members[found->ensemble->worst].worst_constraint);
  EXPECT_EQ(found->constraints_met,
            found->design.verification.passed && found->ensemble->within_constraints == 2);
  EXPECT_FALSE(found->trade);
  EXPECT_EQ(assessment_of(study, *found).parts, 2U);

  EXPECT_FALSE(state_space_candidate(mission, ensemble, study, {}, 10.0));
  const auto nominal = state_space_candidate(mission, {}, study, limit_of(problem, loops), 10.0);
  ASSERT_TRUE(nominal);
  EXPECT_EQ(nominal->tuned_for, TunedFor::nominal);
}

TEST(StateSpaceStudy, VerdictIsTheFirstThatApplies) {
  StateSpaceStudy study;
  EXPECT_EQ(verdict(study), StateSpaceVerdict::incomplete);
  study.change = {-0.03, 0.01, -0.05, -0.01};
  EXPECT_EQ(verdict(study), StateSpaceVerdict::limit_cycle);
  study.limit_cycle_free = true;
  EXPECT_EQ(verdict(study), StateSpaceVerdict::better);
  study.simulated.result.slew.emplace();
  EXPECT_EQ(verdict(study), StateSpaceVerdict::unsettled);
  study.simulated.result.slew->settling_time = 0.0;
  EXPECT_EQ(verdict(study), StateSpaceVerdict::better);
  study.change->value = -0.015;
  EXPECT_EQ(verdict(study), StateSpaceVerdict::no_advantage);
  study.change = {-0.03, 0.015, -0.06, 0.0};
  EXPECT_EQ(verdict(study), StateSpaceVerdict::no_advantage);
}

TEST(StateSpaceStudy, NeedsAControllerAndANonlinearAntenna) {
  Mission mission = reference::demo_mission();
  const TrackingProblem problem = tracking_problem(mission);
  EXPECT_FALSE(study_state_space(mission, problem, {}, {}, 1));
  mission.antenna.nonlinear.reset();
  const control::Controller loops = reference::lag_loops();
  EXPECT_FALSE(study_state_space(mission, problem, limit_of(problem, loops), {}, 1));
}

}  // namespace
}  // namespace boresight::design
