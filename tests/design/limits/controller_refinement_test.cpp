#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/limits/controller_refinement.hpp>
#include <boresight/design/limits/lqg_search.hpp>
#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TrackingProblem problem_with_torque_noise() {
  TrackingProblem problem = reference::tracking_problem();
  problem.noise.torque_rms = 0.5;
  return problem;
}

SampledSetting setting_of(const TrackingProblem& problem, const plant::AntennaPlant& plant) {
  return {"plant",       plant, fit_wind_filter(problem),
          problem.noise, 0.02,  plant::frequency_grid(problem.plant, 1e-3, 24.9, 100)};
}

// With one plant, next to no limit on peaks and the order of the LQG, the optimum is known: no
// linear controller of that effort is better (EffortBound).
TEST(ControllerRefinement, ComesNearTheBoundWhereItIsAttainable) {
  const TrackingProblem problem = problem_with_torque_noise();
  const std::vector<SampledSetting> itself{setting_of(problem, problem.plant)};
  const SampledLoopGoals goals{20.0, 0.6, 3.0};
  const RobustConstraints constraints({itself}, goals, 1);
  // With half the effort and a limit on its peak.
  const auto lqg = search_limited_lqg(itself.front(), {2.0, 0.3, 3.0});
  ASSERT_TRUE(lqg.found);
  const plant::StateSpace& start = lqg.controller;
  const double bound =
      pointing_limit(problem, {}, {}, {}).bound.min_rms(goals.control_effort) * problem.gear_ratio;
  const double before = itself.front().boresight_rms(start);
  ASSERT_GT(before, 1.2 * bound);
  const auto found = refine_controller(start, constraints, {.steps = 60});
  EXPECT_EQ(found.controller.a.rows(), start.a.rows());
  EXPECT_DOUBLE_EQ(found.boresight_rms, itself.front().boresight_rms(found.controller));
  EXPECT_GE(found.boresight_rms, bound * (1.0 - 1e-5));
  EXPECT_LE(found.boresight_rms, 1.1 * bound);
  EXPECT_LE(constraints.excess(found.controller), 0.0);
}

TEST(ControllerRefinement, LowersTheWorstRmsWithinTheConstraints) {
  const TrackingProblem problem = problem_with_torque_noise();
  std::vector<SampledSetting> plants{setting_of(problem, problem.plant)}, held;
  for (const double factor : {0.96, 1.04}) {
    plant::AntennaPlant other = problem.plant;
    for (auto& mode : other.structure.modes) mode.stiffness *= factor * factor;
    plants.push_back(setting_of(problem, other));
  }
  plant::AntennaPlant stuck = problem.plant;
  stuck.drive.viscous_friction = 300.0;
  held.push_back(setting_of(problem, stuck));
  const RobustConstraints constraints({plants, held}, {}, 1);
  const auto lqg = search_robust_lqg(plants.front(), constraints);
  ASSERT_TRUE(lqg.found);
  const auto found = refine_controller(lqg.controller, constraints, {.steps = 12});
  EXPECT_GT(found.steps, 0);
  EXPECT_LT(found.boresight_rms, 0.97 * lqg.boresight_rms);
  EXPECT_DOUBLE_EQ(found.boresight_rms, constraints.largest_rms(found.controller));
  EXPECT_LE(constraints.excess(found.controller), 0.0);
  EXPECT_EQ(found.controller.a.rows(), lqg.controller.a.rows());
  EXPECT_LE(held.front().boresight_rms(found.controller),
            1.16 * held.front().boresight_rms(lqg.controller));

  const RobustConstraints threaded({plants, held}, {}, 3);
  const auto again = refine_controller(lqg.controller, threaded, {.steps = 12});
  EXPECT_EQ(again.controller.a, found.controller.a);
  EXPECT_EQ(again.controller.b, found.controller.b);
  EXPECT_EQ(again.evaluations, found.evaluations);

  EXPECT_THAT([&] { (void)refine_controller(lqg.controller, constraints, {.steps = 0}); },
              ThrowsMessage<InvalidInput>(HasSubstr("at least 1 step")));
  plant::StateSpace unstable = lqg.controller;
  unstable.c *= -1.0;
  EXPECT_THAT([&] { (void)refine_controller(unstable, constraints); },
              ThrowsMessage<InvalidInput>(HasSubstr("expected a start that is stable")));
}

// Loops on the problem's own plant with pairs of poles added, for the search to use.
struct LoopsWithIdlePairs {
  TrackingProblem problem = problem_with_torque_noise();
  std::vector<SampledSetting> plants{setting_of(problem, problem.plant)};
  plant::StateSpace start;

  LoopsWithIdlePairs() {
    const plant::StateSpace loops =
        control::sampled_loop(plants.front().problem().plant, reference::lag_loops(), 0.02)
            .controller;
    start = with_idle_pairs(loops, std::array{1.5, 3.0, 6.0, 12.0, 24.0}, 0.5);
  }

  double rms(const plant::StateSpace& controller) const {
    return plants.front().boresight_rms(controller);
  }
};

// The loops have more effort than allowed.
TEST(ControllerRefinement, LeadsAStartThatViolatesConstraintsToWhereItMeetsThem) {
  const PoleBounds poles{.slowest = 0.3};
  const LoopsWithIdlePairs loops;
  const double effort = loops.plants.front().control_effort(loops.start);
  const RobustConstraints constraints({loops.plants}, {2.5, 0.9 * effort}, 1);
  ASSERT_GT(constraints.excess(loops.start), 0.05);
  const auto found = refine_controller(loops.start, constraints, {.steps = 30, .poles = poles});
  ASSERT_TRUE(found.feasible);
  ASSERT_GT(found.steps, 4);
  EXPECT_FALSE(found.violations.has_value());
  EXPECT_LE(constraints.excess(found.controller), 0.0);
  EXPECT_LT(found.boresight_rms, loops.rms(loops.start));
  EXPECT_GT(bounds_of(found.controller).slowest, 0.99 * poles.slowest);

  // Violations are counted at the last step, then at earlier ones until there are none, then
  // between.
  std::vector<double> evaluated;
  std::vector<int> limits;
  const auto with = [&](const std::function<int(double)>& violations) {
    evaluated.clear();
    limits.clear();
    return refine_controller(
        loops.start, constraints,
        {.steps = 30,
         .poles = poles,
         .violations = [&, violations](const plant::StateSpace& controller, int enough) {
           evaluated.push_back(loops.rms(controller));
           limits.push_back(enough);
           return std::min(violations(evaluated.back()), enough);
         }});
  };
  const double bound = 1.003 * found.boresight_rms;
  const auto earlier = with([&](double rms) { return rms < bound ? 3 : 0; });
  ASSERT_TRUE(earlier.feasible);
  EXPECT_LT(earlier.steps, found.steps);
  ASSERT_GT(evaluated.size(), 1U);
  EXPECT_EQ(evaluated.front(), found.boresight_rms);
  EXPECT_GE(earlier.boresight_rms, bound);
  EXPECT_LE(constraints.excess(earlier.controller), 0.0);
  // The last of the evaluated steps without violations, which as objectives fall is the best.
  for (const double rms : evaluated) EXPECT_TRUE(rms < bound || rms >= earlier.boresight_rms);
  EXPECT_EQ(with([](double) { return 0; }).controller.b, found.controller.b);
  EXPECT_EQ(evaluated.size(), 1U);
  const auto violated = with([](double) { return 3; });
  EXPECT_EQ(violated.controller.b, found.controller.b);
  EXPECT_EQ(violated.violations, 3);
  EXPECT_GT(evaluated.size(), 1U);
  const std::vector<double> all = evaluated;  // of the last step, and 2 and 6 steps before it
  // As many as the best step has need not be counted further.
  EXPECT_GT(limits.front(), 1000);
  EXPECT_EQ(limits[1], 3);
  // Only the last step has some: the one before it would gain less than 1 %.
  const auto before_last = with([&](double rms) { return rms <= found.boresight_rms ? 3 : 0; });
  EXPECT_EQ(before_last.steps, found.steps - 2);
  EXPECT_EQ(before_last.violations, 0);
  EXPECT_EQ(evaluated.size(), 2U);
  // Where more can be gained, steps between are evaluated by halving.
  ASSERT_GT(all.size(), 2U);
  ASSERT_GT(all[2], 1.01 * all[1]);
  const auto between = with([&](double rms) { return rms < 0.999 * all[2] ? 3 : 0; });
  EXPECT_GE(between.steps, found.steps - 6);
  EXPECT_EQ(between.violations, 0);
  EXPECT_GT(evaluated.size(), 3U);
  // None is without: the one with the fewest, though it is not the last.
  EXPECT_GE(with([&](double rms) { return rms < bound ? 3 : 1; }).boresight_rms, bound);
  EXPECT_LE(evaluated.size(), 6U);
  // Only the first step is without.
  const double at_first = evaluated.back();
  EXPECT_EQ(with([&](double rms) { return rms < at_first ? 3 : 0; }).boresight_rms, at_first);
}

// From loops that have less static gain than is asked, and in exact agreement with the gain by
// which a steady load is judged.
TEST(ControllerRefinement, ReachesTheStaticGainThatIsAsked) {
  const LoopsWithIdlePairs loops;
  const auto static_gain = [](const plant::StateSpace& controller) {
    plant::StateSpace named = controller;
    named.outputs = {"valve_demand"};
    return control::static_encoder_gain(control::state_space_controller("refined", named));
  };
  SampledLoopGoals goals{2.5, 0.6};
  const auto refined = [&] {
    return refine_controller(loops.start, {{loops.plants}, goals, 1},
                             {.steps = 40, .poles = {.slowest = 0.3}});
  };
  const auto free = refined();
  ASSERT_TRUE(free.feasible);
  goals.static_gain = 1.4 * std::max(static_gain(free.controller), static_gain(loops.start));
  const RobustConstraints constraints({loops.plants}, goals, 1);
  EXPECT_NEAR(constraints.peaks(loops.start).tail(1)[0],
              std::log(*goals.static_gain / static_gain(loops.start)), 1e-9);
  const auto limited = refined();
  ASSERT_TRUE(limited.feasible);
  EXPECT_GE(static_gain(limited.controller), *goals.static_gain);
  EXPECT_LT(static_gain(limited.controller), 1.1 * *goals.static_gain);
  // Either is a local optimum.
  EXPECT_GT(limited.boresight_rms, 0.95 * free.boresight_rms);
  EXPECT_LT(limited.boresight_rms, loops.rms(loops.start));
  goals.static_gain = -1.0;
  EXPECT_THROW(validate(goals), InvalidInput);
}

// The structure is less damped than the controller's poles may be.
TEST(ControllerRefinement, LimitsThePositionLoopAndTheDampingOfTheController) {
  const PoleBounds poles{.slowest = 0.1, .damping = 0.1};
  const LoopsWithIdlePairs loops;
  const auto position_peak = [&](const plant::StateSpace& controller) {
    const SampledSetting& plant = loops.plants.front();
    return plant
        .highest_position_peak(SampledSetting::controller_response(controller, plant.frequency()))
        .magnitude;
  };
  SampledLoopGoals goals{2.5, 0.6};
  const auto refined = [&] {
    return refine_controller(loops.start, {{loops.plants}, goals, 1},
                             {.steps = 40, .poles = poles});
  };
  const auto free = refined();
  ASSERT_TRUE(free.feasible);
  goals.position_peak = 1.0 + 0.8 * (position_peak(free.controller) - 1.0);
  const auto limited = refined();
  EXPECT_TRUE(limited.feasible);
  EXPECT_LE(position_peak(limited.controller), *goals.position_peak);
  EXPECT_GT(position_peak(limited.controller), 0.9 * *goals.position_peak);
  for (const auto& one : {free, limited}) {
    EXPECT_LT(one.boresight_rms, loops.rms(loops.start));
    EXPECT_GT(bounds_of(one.controller).damping, 0.098);
    EXPECT_GT(bounds_of(one.controller).slowest, 0.098);
  }
}

}  // namespace
}  // namespace boresight::design
