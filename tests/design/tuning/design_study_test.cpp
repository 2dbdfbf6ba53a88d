#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using control::LoopStructure;
using reference::relative_error;

DesignTask task(const std::string& name, LoopStructure structure, double disks) {
  DesignTask task;
  task.name = name;
  task.problem = reference::tracking_problem(disks);
  task.problem.points_per_decade = 60;
  task.structure = structure;
  task.options.starts = 3;
  task.options.evaluations_per_start = 60;
  return task;
}

TEST(Verify, PassesACautiousControllerAndFailsAWildOne) {
  const TrackingProblem problem = reference::tracking_problem();
  const auto sound = verify(problem, reference::cautious_gains(), {});
  EXPECT_TRUE(sound.stability.stable());
  EXPECT_TRUE(sound.passed);
  EXPECT_LT(relative_error(sound.lyapunov.total, sound.spectral_rms), 5e-3);
  EXPECT_NEAR(sound.rms_disagreement, relative_error(sound.lyapunov.total, sound.spectral_rms),
              1e-15);
  const auto wild = verify(problem, {LoopStructure::pi(), {20.0, 1.0, 0.05, 1e-3}}, {});
  EXPECT_FALSE(wild.stability.stable());
  EXPECT_FALSE(wild.passed);
  EXPECT_EQ(wild.lyapunov.total, 0.0);
}

TEST(Verify, FailsAStableControllerWhosePeakIsTooHigh) {
  const TrackingProblem problem = reference::tracking_problem();
  const auto controller = reference::cautious_gains();
  const auto peaks = verify(problem, controller, {}).peaks;
  for (std::size_t b = 0; b < 3; ++b) {
    Constraints goals;
    goals.sensitivity_peak[b] = 0.999 * peaks[b].upper;
    EXPECT_FALSE(verify(problem, controller, goals).passed) << b;
    goals.sensitivity_peak[b] = 1.001 * peaks[b].upper;
    EXPECT_TRUE(verify(problem, controller, goals).passed) << b;
  }
}

TEST(Solve, GivesOneDesignInSkyUnitsWithItsMargins) {
  const DesignTask one = task("24 disks", LoopStructure::pi_with_lag(), 24.0);
  const Design design = solve(one);
  EXPECT_EQ(design.name, "24 disks");
  const auto& evaluation = design.tuning.evaluation;
  EXPECT_LT(relative_error(design.boresight_rms * one.problem.gear_ratio,
                           std::sqrt(evaluation.boresight_variance())),
            1e-14);
  EXPECT_LT(relative_error(std::hypot(design.wind_rms, design.noise_rms), design.boresight_rms),
            1e-12);
  EXPECT_NEAR(design.hydraulic_mode.frequency, 0.848, 5e-4);
  EXPECT_NEAR(
      design.reflected_inertia,
      reference::motor_inertia(24.0) + reference::gear_train_inertia + reference::antenna_inertia(),
      1e-12);
  // A peak of |S| of M leaves at least a factor M/(M - 1) of gain and 2 asin(1/2M) of phase.
  for (std::size_t b = 0; b < 3; ++b) {
    const double m = design.verification.peaks[b].lower;
    EXPECT_GE(design.margins[b].increasing_gain_margin, m / (m - 1.0) * (1.0 - 1e-6));
    EXPECT_LE(design.margins[b].decreasing_gain_margin, m / (m + 1.0) * (1.0 + 1e-6));
    EXPECT_GE(design.margins[b].phase_margin_deg,
              2.0 * std::asin(0.5 / m) * 180.0 / std::numbers::pi - 1e-3);
    EXPECT_GT(design.margins[b].delay_margin, 0.0);
  }
}

TEST(SolveAll, GivesTheSameBytesOnOneThreadAndOnTwo) {
  const std::vector<DesignTask> tasks{
      task("a", LoopStructure::pi(), 24.0), task("b", LoopStructure::pi_with_lag(), 24.0),
      task("c", LoopStructure::pi(), 8.0), task("d", LoopStructure::pi(), 0.0)};
  std::vector<std::size_t> calls;
  const auto one = solve_all(tasks, 1, [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 4u);
    calls.push_back(done);
  });
  const auto two = solve_all(tasks, 2, {});
  EXPECT_THAT(calls, testing::ElementsAre(1, 2, 3, 4));
  ASSERT_EQ(one.size(), 4u);
  ASSERT_EQ(two.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(one[i].name, tasks[i].name);
    EXPECT_EQ(one[i].name, two[i].name);
    EXPECT_EQ(one[i].tuning.controller.gains, two[i].tuning.controller.gains);
    EXPECT_EQ(one[i].boresight_rms, two[i].boresight_rms);
    EXPECT_EQ(one[i].verification.lyapunov.total, two[i].verification.lyapunov.total);
    EXPECT_EQ(one[i].verification.passed, two[i].verification.passed);
  }
}

TEST(SolveAll, HandsOnTheErrorOfATask) {
  std::vector<DesignTask> tasks{task("a", LoopStructure::pi(), 24.0),
                                task("b", LoopStructure::pi(), 24.0)};
  tasks[1].options.starts = 0;
  EXPECT_THROW(solve_all(tasks, 2, {}), InvalidInput);
  EXPECT_TRUE(solve_all({}, 2, {}).empty());
}

TEST(Verify, SaysWhyItFails) {
  const TrackingProblem problem = reference::tracking_problem();
  Constraints narrow;
  narrow.sensitivity_peak = {1.01, 1.01, 1.01};
  const auto strict = verify(problem, reference::cautious_gains(), narrow);
  EXPECT_FALSE(strict.passed);
  EXPECT_THAT(strict.failure, testing::HasSubstr("Ms at"));
  const auto wild = verify(problem, {LoopStructure::pi(), {20.0, 1.0, 0.05, 1e-3}}, {});
  EXPECT_THAT(wild.failure, testing::HasSubstr("not stable"));
  Constraints quiet;
  quiet.control_effort = 1e-6;
  EXPECT_THAT(verify(problem, reference::cautious_gains(), quiet).failure,
              testing::HasSubstr("control effort"));
}

TEST(Verify, DoesNotDependOnTheBandOfTheRms) {
  TrackingProblem problem = reference::tracking_problem();
  const auto whole = verify(problem, reference::cautious_gains(), {});
  problem.rms_band = {0.01, 2.0};
  const auto part = verify(problem, reference::cautious_gains(), {});
  EXPECT_TRUE(part.passed);
  EXPECT_LT(relative_error(part.spectral_rms, whole.spectral_rms), 1e-4);
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_LT(relative_error(part.peaks[b].lower, whole.peaks[b].lower), 1e-9);
  }
}

TEST(ImproveAlong, BringsANeighboursOptimumWhereRandomStartsMissedIt) {
  std::vector<DesignTask> tasks;
  for (const double disks : {24.0, 21.0, 18.0}) {
    tasks.push_back(task("", LoopStructure::pi_with_lag(), disks));
  }
  auto designs = solve_all(tasks, 1, {});
  // A cautious controller in place of the middle's optimum.
  designs[1].tuning.controller = reference::cautious_gains();
  designs[1].tuning.evaluation =
      make_evaluator(tasks[1].problem).evaluate(designs[1].tuning.controller, false);
  designs[1].tuning.status = TuningStatus::optimal;
  const auto before = designs;
  improve_along(tasks, designs);
  // Fewer disks point better than more (the neighbour's controller, re-tuned).
  EXPECT_LT(designs[1].boresight_rms, designs[0].boresight_rms);
  EXPECT_TRUE(designs[1].verification.passed);
  for (std::size_t i = 0; i < designs.size(); ++i) {
    EXPECT_LE(designs[i].tuning.evaluation.boresight_variance(),
              before[i].tuning.evaluation.boresight_variance());
  }
  designs.pop_back();
  EXPECT_THROW(improve_along(tasks, designs), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
