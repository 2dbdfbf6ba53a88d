#include <cmath>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/studies/state_space_study.hpp>
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
  const control::Controller loops{control::LoopStructure::named("LL+L"),
                                  {0.3, 3.0, 40.0, 4.0, 1.5, 15.0}};
  const auto simulated =
      verify_in_time_domain(mission, problem, loops, "LL+L", 1, 2, SecondIntegrator::none);
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
            is_limit_cycle_free(simulated->result.limit_cycles, tightest_budget(mission)));
  const auto& at_rest = simulated->result.limit_cycles.front();
  ASSERT_EQ(at_rest.rate, 0.0);
  EXPECT_EQ(
      shows_no_limit_cycle(mission, problem, study->controller, {.tracking = false, .threads = 2}),
      at_rest.starts_with_limit_cycle == 0);
  // A first look at 40 s tells the same as 200 s.
  EXPECT_EQ(shows_no_limit_cycle(mission, problem, study->controller,
                                 {.first_look = 40.0, .tracking = false, .threads = 2}),
            at_rest.starts_with_limit_cycle == 0);
  const auto& tracking = simulated->result.limit_cycles.back();
  ASSERT_NE(tracking.rate, 0.0);
  EXPECT_EQ(shows_no_limit_cycle(mission, problem, study->controller, {.threads = 2}),
            at_rest.starts_with_limit_cycle + tracking.starts_with_limit_cycle == 0);
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
  const control::Controller loops{control::LoopStructure::named("LL+L"),
                                  {0.3, 3.0, 40.0, 4.0, 1.5, 15.0}};
  EXPECT_FALSE(study_state_space(mission, problem, limit_of(problem, loops), {}, 1));
}

}  // namespace
}  // namespace boresight::design
