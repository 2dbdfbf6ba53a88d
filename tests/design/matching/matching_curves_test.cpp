#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/matching/matching_curves.hpp>
#include <boresight/design/matching/matching_smoothness.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using control::LoopStructure;

MatchingTask task(std::vector<double> disks, std::vector<LoopStructure> structures) {
  MatchingTask task;
  task.problem = reference::tracking_problem();
  const auto all = reference_ensemble(task.problem, 1);
  // The nominal plant and the corners: half of the members that ever matter.
  task.members.assign(all.begin(), all.begin() + 6);
  for (const double count : disks) {
    task.motor_inertia.push_back(reference::antenna(count).drive.motor_inertia);
  }
  task.structures = std::move(structures);
  return task;
}

const MatchingTask& small_task() {
  static const MatchingTask one =
      task({15.0, 18.0, 21.0, 24.0}, {LoopStructure::pi(), LoopStructure::pi_with_lag()});
  return one;
}

const MatchingCurves& small_study() {
  static const MatchingCurves curves = match_motors(small_task(), {});
  return curves;
}

std::string message_of(const MatchingTask& task, const MatchingOptions& options) {
  try {
    match_motors(task, options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(MatchingCurves, FindsWhatALongSearchAtOneInertiaFinds) {
  TuningOptions options;
  options.members = small_task().members;
  options.starts = 15;
  TrackingProblem problem = small_task().problem;
  for (std::size_t s = 0; s < 2; ++s) {
    const auto& structure = small_task().structures[s];
    const auto alone = tune(problem, structure, {}, options);
    const auto& controller = small_study().curves[s].controllers.back();
    ASSERT_EQ(controller.status, TuningStatus::optimal);
    EXPECT_LT(controller.soft_rms, alone.soft_rms * (1.0 + 3.0 * small_study().tolerance));
  }
}

TEST(MatchingCurves, EveryControllerHoldsItsGoalsOnEveryPlant) {
  for (const auto& curve : small_study().curves) {
    for (std::size_t i = 0; i < curve.controllers.size(); ++i) {
      MatchingTask there = small_task();
      const double factor = there.motor_inertia[i] / there.problem.plant.drive.motor_inertia;
      there.problem.plant.drive.motor_inertia *= factor;
      for (auto& member : there.members) member.plant.drive.motor_inertia *= factor;
      const auto evaluated =
          evaluate(there.problem, there.members, curve.controllers[i].controller, {}, 1);
      EXPECT_EQ(evaluated.within_constraints, 6);
      const double rms = evaluated.members.front().boresight_rms * there.problem.gear_ratio;
      EXPECT_NEAR(curve.controllers[i].soft_rms / rms, 1.0, 1e-5);
    }
  }
}

TEST(MatchingCurves, AStructureIsNeverWorseThanWhatItExtends) {
  for (std::size_t i = 0; i < 4; ++i) {
    const double part = small_study().curves[0].controllers[i].soft_rms;
    EXPECT_LT(small_study().curves[1].controllers[i].soft_rms,
              part * (1.0 + small_study().tolerance));
  }
}

TEST(MatchingCurves, OtherSeedsFindTheSame) {
  MatchingOptions options;
  options.seed = 77;
  const auto other = match_motors(small_task(), options);
  EXPECT_TRUE(other.settled);
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(
          other.curves[s].controllers[i].soft_rms / small_study().curves[s].controllers[i].soft_rms,
          1.0, 5e-3);
    }
  }
}

TEST(MatchingCurves, ThreadsMakeNoDifference) {
  MatchingOptions options;
  options.threads = 3;
  const auto other = match_motors(small_task(), options);
  EXPECT_EQ(other.rounds, small_study().rounds);
  EXPECT_EQ(other.evaluations, small_study().evaluations);
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(other.curves[s].controllers[i].controller.gains,
                small_study().curves[s].controllers[i].controller.gains);
    }
  }
}

// Above 15 disks one goal on one plant holds each of the PI controllers: no kinks, smooth curves.
TEST(MatchingCurves, ThirdDifferencesStayWithinThreeTolerances) {
  const auto even = smoothness(small_study().curves[1], {0, 1, 2, 3});
  ASSERT_EQ(even.third_differences.size(), 1U);
  EXPECT_LT(std::abs(even.third_differences[0]), 3.0 * small_study().tolerance);
}

TEST(MatchingCurves, AnInterruptLeavesWhatWasWhole) {
  MatchingOptions options;
  int steps = 0;
  options.progress = [&](std::size_t, std::size_t) { ++steps; };
  options.stop = [&] { return steps >= 3; };
  const auto stopped = match_motors(small_task(), options);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_FALSE(stopped.settled);
  EXPECT_EQ(stopped.curves[0].controllers[0].status, TuningStatus::optimal);
  EXPECT_FALSE(stopped.curves[1].controllers[3].searched);
  EXPECT_EQ(stopped.curves[1].controllers[3].status, TuningStatus::unstable);
}

TEST(MatchingCurves, ProgressEndsAtAll) {
  MatchingTask one = task({24.0}, {LoopStructure::pi()});
  one.members.clear();
  MatchingOptions options;
  std::size_t last = 0, total = 0;
  options.progress = [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(done, last + 1);
    last = done;
    total = all;
  };
  match_motors(one, options);
  EXPECT_EQ(last, total);
}

TEST(MatchingCurves, SaysWhatItCannotWorkOn) {
  MatchingTask wrong = small_task();
  wrong.motor_inertia.clear();
  EXPECT_EQ(message_of(wrong, {}),
            "match_motors: expected at least one motor inertia and one structure");
  wrong.motor_inertia = {1.0, 1.0};
  EXPECT_EQ(message_of(wrong, {}),
            "match_motors: expected positive motor inertias that rise, found 1 after 1 kg.m2");
  wrong = small_task();
  wrong.structures.push_back(LoopStructure::pi());
  EXPECT_EQ(message_of(wrong, {}),
            "match_motors: expected each structure once, found 'PI without lag' again");
  MatchingOptions options;
  options.starts = 0;
  EXPECT_EQ(message_of(small_task(), options), "match_motors: expected at least 1 start, found 0");
  options.starts = 1;
  options.tolerance = 0.5;
  EXPECT_EQ(message_of(small_task(), options),
            "match_motors: expected a tolerance within (0, 0.1), found 0.5");
}

// ln rms = x^3/1000 along the points has the third difference 6/1000; a change of what holds the
// controllers takes the stretches across it out.
TEST(MatchingSmoothness, TellsKinksFromUnevenness) {
  MatchingCurve curve{LoopStructure::pi(), {}};
  for (int i = 0; i < 8; ++i) {
    MatchedController controller;
    controller.status = TuningStatus::optimal;
    controller.controller = {LoopStructure::pi(), {0.2, 0.8, 0.2, 0.02}};
    controller.soft_rms = std::exp(1e-3 * i * i * i) * (i > 4 ? 1.1 : 1.0);
    ActiveConstraint goal;
    goal.goal.frequency = i > 4 ? 10.0 : 5.0;
    controller.active_constraints = {goal};
    curve.controllers.push_back(controller);
  }
  const auto found = smoothness(curve, {0, 1, 2, 3, 4, 5, 6, 7});
  ASSERT_EQ(found.third_differences.size(), 5U);
  EXPECT_EQ(found.even_stretches, 2U);
  EXPECT_NEAR(found.largest_even, 6e-3, 1e-12);
  EXPECT_GT(found.largest_at_kinks, 0.09);
  ASSERT_EQ(found.kinks.size(), 1U);
  EXPECT_EQ(found.kinks[0].after, 4U);
  EXPECT_EQ(found.kinks[0].change, "from sensitivity peak, 0.80 Hz to sensitivity peak, 1.59 Hz");
  EXPECT_THROW(smoothness(curve, {8}), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
