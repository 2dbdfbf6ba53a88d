#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/limits/refinement_problem.hpp>

namespace boresight::design {
namespace {

// Loops on a plant and on one at standstill, well within their constraints.
struct Refined {
  TrackingProblem problem = [] {
    TrackingProblem result = reference::tracking_problem();
    result.noise.torque_rms = 0.5;
    return result;
  }();
  SampledSetting with_friction(double friction) const {
    plant::AntennaPlant plant = problem.plant;
    plant.drive.viscous_friction = friction;
    return {"plant",       plant, fit_wind_filter(problem),
            problem.noise, 0.02,  plant::frequency_grid(problem.plant, 1e-3, 24.9, 100)};
  }
  std::vector<SampledSetting> plants{with_friction(0.9)}, held{with_friction(5.0)};
  plant::StateSpace start =
      control::sampled_loop(plants.front().problem().plant, reference::lag_loops(), 0.02)
          .controller;
  SampledLoopGoals goals{.sensitivity_peak = 5.0,
                         .control_effort = 1.3 * plants.front().control_effort(start),
                         .standstill_peak = 8.0,
                         .position_peak = 4.0};
  RobustConstraints constraints{{plants, held}, goals, 1};

  // The start's own peak at the valve is the goal.
  RobustConstraints with_active_peak() const {
    SampledLoopGoals tight = goals;
    tight.sensitivity_peak *= std::exp(constraints.peaks(start)[0]);
    return {{plants, held}, tight, 1};
  }
};

TEST(RefinementProblem, ObjectiveIsTheLargestRatioToTheStart) {
  const Refined refined;
  const RefinementProblem problem(refined.start, refined.constraints, {});
  const Eigen::VectorXd rms = refined.constraints.rms(refined.start);
  ASSERT_EQ(rms.size(), 2);
  EXPECT_NEAR(problem.objective(rms), 0.0, 1e-12);
  EXPECT_NEAR(problem.objective(Eigen::Vector2d(1.3 * rms[0], rms[1])), std::log(1.3), 1e-12);
  // With the allowance at standstill.
  EXPECT_NEAR(problem.objective(Eigen::Vector2d(0.1 * rms[0], 1.3 * rms[1])), std::log(1.3 / 1.15),
              1e-12);
  // Each plant to its own, not to the largest.
  const std::vector<SampledSetting> two{refined.with_friction(0.9), refined.with_friction(60.0)};
  const RobustConstraints both({.plants = two}, refined.goals, 1);
  Eigen::VectorXd own = both.rms(refined.start);
  const Eigen::Index lower = own[0] < own[1] ? 0 : 1;
  ASSERT_LT(own[lower], 0.99 * own[1 - lower]);
  own[lower] *= 1.005;
  EXPECT_NEAR(RefinementProblem(refined.start, both, {}).objective(own), std::log(1.005), 1e-12);
}

// The search's own values and gradients lead to what the exact quantities confirm.
TEST(RefinementProblem, AStepGainsWhatItsControllerShows) {
  const Refined refined;
  ASSERT_LT(refined.constraints.excess(refined.start), -0.05);
  const RefinementProblem problem(refined.start, refined.constraints, {});
  const auto step = problem.step(0.05);
  EXPECT_GT(step.gain, 0.01);
  EXPECT_EQ(step.violation, 0.0);
  const double objective = problem.objective(refined.constraints.rms(step.controller));
  EXPECT_NEAR(-objective, step.gain, 1e-3 * step.gain + 1e-5);
  const Eigen::VectorXd exact = refined.constraints.peaks(step.controller);
  ASSERT_EQ(step.peaks.size(), exact.size());
  EXPECT_LT((step.peaks - exact).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_GE((step.peaks - exact).minCoeff(), -1e-3);
  // A smaller box holds less.
  EXPECT_LT(problem.step(0.01).gain, step.gain);
}

// Where the peak is an active constraint, a correction of 1 % lowers it by 1 %.
TEST(RefinementProblem, CorrectionsTightenTheirOwnConstraint) {
  const Refined refined;
  const RobustConstraints active = refined.with_active_peak();
  RefinementProblem problem(refined.start, active, {});
  constexpr double radius = 0.05;
  const auto before = problem.step(radius);
  ASSERT_GT(before.peaks[0], -0.004);
  EXPECT_FALSE(problem.correct(before, before.peaks, RefinementProblem::Correction::more));
  Eigen::VectorXd exact = before.peaks;
  exact[0] += 0.01;
  EXPECT_TRUE(problem.correct(before, exact, RefinementProblem::Correction::more));
  const auto after = problem.step(radius);
  EXPECT_LT(after.violation, 1e-3);
  EXPECT_NEAR(before.peaks[0] - after.peaks[0], 0.01, 1.5e-3);
  // `more` keeps a correction, `afresh` leaves 70 % of one that is not needed.
  EXPECT_FALSE(problem.correct(before, before.peaks, RefinementProblem::Correction::more));
  EXPECT_EQ(problem.step(radius).peaks[0], after.peaks[0]);
  EXPECT_FALSE(problem.correct(before, before.peaks, RefinementProblem::Correction::afresh));
  const double part =
      (before.peaks[0] - problem.step(radius).peaks[0]) / (before.peaks[0] - after.peaks[0]);
  // 0.7 of the whole correction, 0.01 and the margin of 0.002, less that margin.
  EXPECT_NEAR(part, 0.64, 0.08);
}

// The correction that only a longer step needed is halved, that of the centre stays.
TEST(RefinementProblem, CorrectionsShrinkWithTheStep) {
  const Refined refined;
  const RobustConstraints active = refined.with_active_peak();
  RefinementProblem problem(refined.start, active, {});
  constexpr double radius = 0.05;
  const auto without = problem.step(radius);
  const auto correct = [&](double by, RefinementProblem::Correction how) {
    Eigen::VectorXd exact = without.peaks;
    exact[0] += by;
    return problem.correct(without, exact, how);
  };
  ASSERT_TRUE(correct(0.004, RefinementProblem::Correction::afresh));
  const double of_centre = problem.step(radius).peaks[0];
  ASSERT_TRUE(correct(0.014, RefinementProblem::Correction::more));
  const double whole = problem.step(radius).peaks[0];
  problem.ease_corrections();
  const double eased = problem.step(radius).peaks[0];
  EXPECT_NEAR((of_centre - eased) / (of_centre - whole), 0.5, 0.1);
  for (int i = 0; i < 12; ++i) problem.ease_corrections();
  EXPECT_NEAR(problem.step(radius).peaks[0], of_centre, 1e-4);
}

// Corners limit the peak at the valve, as the plants do, and no other figure.
TEST(RefinementProblem, CornersLimitThePeakAlone) {
  const Refined refined;
  const std::vector<SampledSetting> corner{refined.with_friction(0.1)};
  const RobustConstraints with({.plants = refined.plants, .corners = corner}, refined.goals, 1);
  const RobustConstraints without({.plants = refined.plants}, refined.goals, 1);
  EXPECT_EQ(with.rms(refined.start), without.rms(refined.start));
  const auto response =
      SampledSetting::controller_response(refined.start, corner.front().frequency());
  const double peak = corner.front().highest_peak(response).magnitude;
  ASSERT_EQ(with.peaks(refined.start).size(), without.peaks(refined.start).size() + 1);
  EXPECT_NEAR(with.peaks(refined.start)[1], std::log(peak / refined.goals.sensitivity_peak), 1e-12);

  const auto peak_after = [&](const RobustConstraints& constraints) {
    const auto step = RefinementProblem(refined.start, constraints, {}).step(0.1);
    EXPECT_GT(step.gain, 0.01);
    EXPECT_LT(step.violation, 2e-3);
    return corner.front()
        .highest_peak(
            SampledSetting::controller_response(step.controller, corner.front().frequency()))
        .magnitude;
  };
  // A goal that the step without the corner does not meet there.
  SampledLoopGoals goals = refined.goals;
  goals.sensitivity_peak = 0.97 * peak_after(without);
  const RobustConstraints tight({.plants = refined.plants, .corners = corner}, goals, 1);
  EXPECT_LT(peak_after(tight), 1.002 * goals.sensitivity_peak);
  const RobustConstraints unlimited({.plants = refined.plants}, goals, 1);
  EXPECT_GT(peak_after(unlimited), 1.01 * goals.sensitivity_peak);
}

// As an active constraint: the step ends at the limit, and predicts it.
TEST(RefinementProblem, LimitsTheGainOnALockedMotor) {
  const Refined refined;
  const std::vector<SampledSetting> motor_locked{refined.with_friction(1e7)};
  const auto gain = [&](const plant::StateSpace& controller) {
    return motor_locked.front()
        .highest_locked_motor_gain(
            SampledSetting::controller_response(controller, motor_locked.front().frequency()))
        .magnitude;
  };
  const auto step_within = [&](const SampledLoopGoals& goals) {
    const RobustConstraints constraints(
        {.plants = refined.plants, .at_standstill = refined.held, .motor_locked = motor_locked},
        goals, 1);
    auto step = RefinementProblem(refined.start, constraints, {}).step(0.1);
    const Eigen::VectorXd exact = constraints.peaks(step.controller);
    EXPECT_EQ(step.peaks.size(), exact.size());
    // The gain is flat at low frequencies: many of its values count.
    EXPECT_LT((step.peaks - exact).maxCoeff(), 0.016);
    EXPECT_GT((step.peaks - exact).minCoeff(), -1e-3);
    return step;
  };
  SampledLoopGoals goals = refined.goals;
  const auto unlimited = step_within(goals);
  ASSERT_GT(gain(unlimited.controller), 1.02 * gain(refined.start));
  goals.locked_motor_gain = std::sqrt(gain(unlimited.controller) * gain(refined.start));
  const auto limited = step_within(goals);
  EXPECT_EQ(limited.peaks.size(), unlimited.peaks.size() + 1);
  EXPECT_LT(limited.violation, 2e-3);
  EXPECT_GT(limited.gain, 0.2 * unlimited.gain);
  EXPECT_LT(gain(limited.controller), 1.002 * *goals.locked_motor_gain);
  EXPECT_GT(gain(limited.controller), 0.98 * *goals.locked_motor_gain);
}

}  // namespace
}  // namespace boresight::design
