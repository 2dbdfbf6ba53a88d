#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/tuning/plant_evaluator.hpp>
#include <boresight/design/verification/linear_prediction.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using control::Controller;
using control::LoopBreak;
using control::LoopStructure;

constexpr double friction = 300.0;
constexpr std::size_t hardest = 2;  // its place among those of standing()
constexpr auto valve = static_cast<std::size_t>(LoopBreak::valve_command);

Constraints standing() {
  Constraints goals;
  goals.standstill = Standstill{3.0, {50.0, 100.0, friction}};
  return goals;
}

plant::AntennaPlant at_standstill(const TrackingProblem& problem, double slope) {
  plant::AntennaPlant plant = problem.plant;
  plant.drive.viscous_friction = slope;
  return plant;
}

TEST(PlantEvaluator, HasThePeakAtStandstillOfAnIndependentBound) {
  const TrackingProblem problem = reference::tracking_problem();
  const Controller controller = reference::cautious_gains();
  const WindTable wind(problem);
  auto plant = PlantEvaluator::at_standstill(problem, hardest, standing(), wind);
  EXPECT_TRUE(plant.is_at_standstill());
  const PlantEvaluation& found = plant.evaluate(controller, false);
  ASSERT_TRUE(found.stable);
  ASSERT_FALSE(found.ratios.empty());
  for (const auto& goal : found.ratios) EXPECT_EQ(goal.kind, GoalKind::standstill_peak);
  const auto peaks =
      control::sensitivity_bounds(at_standstill(problem, friction), controller, problem.delay);
  EXPECT_NEAR(3.0 * found.worst_ratio(), peaks[valve].upper, 1e-6 * peaks[valve].upper);
}

TEST(PlantEvaluator, HasTheGradientOfThePeakAtStandstill) {
  const TrackingProblem problem = reference::tracking_problem();
  Controller controller = reference::cautious_gains();
  const WindTable wind(problem);
  auto plant = PlantEvaluator::at_standstill(problem, hardest, standing(), wind);
  const auto gradient = plant.evaluate(controller, true).ratios.front().log_gradient;
  for (std::size_t k = 0; k < controller.gains.size(); ++k) {
    const double gain = controller.gains[k], step = 1e-4;
    const auto peak = [&](double factor) {
      controller.gains[k] = gain * factor;
      const double value = std::log(plant.evaluate(controller, false).ratios.front().ratio);
      controller.gains[k] = gain;
      return value;
    };
    EXPECT_NEAR(gradient[k], (peak(1.0 + step) - peak(1.0 - step)) / (2.0 * step), 1e-4) << k;
  }
}

// Without the constraint the integrals of the optimum are unstable at standstill.
TEST(Standstill, IsMetByWhatIsTunedForIt) {
  const TrackingProblem problem = reference::tracking_problem();
  TuningOptions options;
  options.starts = 6;
  const auto structure = LoopStructure::pi_with_lag();
  const auto free = tune(problem, structure, {}, options);
  ASSERT_EQ(free.status, TuningStatus::optimal);
  EXPECT_TRUE(verify(problem, free.controller, {}).passed);
  EXPECT_FALSE(verify(problem, free.controller, standing()).passed);

  const auto tuned = tune(problem, structure, standing(), options);
  ASSERT_EQ(tuned.status, TuningStatus::optimal);
  EXPECT_TRUE(verify(problem, tuned.controller, standing()).passed);
  const Constraints goals = standing();
  for (const double slope : goals.standstill->friction) {
    const auto plant = at_standstill(problem, slope);
    EXPECT_TRUE(control::stability(plant, tuned.controller, problem.delay, analysis_grid(problem))
                    .stable());
    EXPECT_LE(control::sensitivity_bounds(plant, tuned.controller, problem.delay)[valve].upper,
              3.0 * (1.0 + 1e-6));
  }
  // It costs rms, and says so by a shadow price.
  EXPECT_GT(tuned.soft_rms, free.soft_rms);
  EXPECT_TRUE(std::ranges::any_of(tuned.limits, [](const ActiveConstraint& limit) {
    return limit.goal.kind == GoalKind::standstill_peak && limit.shadow_price > 0.0;
  }));
}

TEST(Standstill, OfABadLimitIsRefused) {
  Constraints goals = standing();
  goals.standstill->sensitivity_peak = 1.0;
  EXPECT_THROW(validate(goals), InvalidInput);
  goals = standing();
  goals.standstill->friction = {0.0};
  EXPECT_THROW(validate(goals), InvalidInput);
}

// Leaky loops with a slow integral behind a dead zone.
Controller conditional(double corner) {
  Controller controller{LoopStructure::named("PI+L+D"), {}};
  for (const auto& gain : controller.structure.gains()) {
    controller.gains.push_back(gain.symbol == "kr"    ? 0.3
                               : gain.symbol == "wp"  ? 10.0
                               : gain.symbol == "kp"  ? 0.6
                               : gain.symbol == "wip" ? corner
                               : gain.symbol == "dzp" ? 0.2
                               : gain.symbol == "wpp" ? 0.5
                                                      : 2.0);
  }
  return controller;
}

// The integral counts with what its describing function leaves of it at that friction's amplitude.
TEST(Standstill, TakesAConditionalIntegralByItsDescribingFunction) {
  const TrackingProblem problem = reference::tracking_problem();
  Constraints goals = standing();
  goals.standstill->amplitude = {1.0, 0.5, 0.1};
  const WindTable wind(problem);
  const Controller controller = conditional(0.2);
  std::vector<double> peaks;
  for (std::size_t place = 0; place < 3; ++place) {
    auto plant = PlantEvaluator::at_standstill(problem, place, goals, wind);
    const auto& found = plant.evaluate(controller, true);
    ASSERT_TRUE(found.stable);
    peaks.push_back(3.0 * found.worst_ratio());
    Controller equivalent;
    control::set_linear_equivalent(controller, goals.standstill->amplitude[place], equivalent);
    const auto expected = control::sensitivity_bounds(
        at_standstill(problem, goals.standstill->friction[place]), equivalent, problem.delay);
    EXPECT_NEAR(peaks.back(), expected[valve].upper, 1e-6 * peaks.back()) << place;
    EXPECT_TRUE(plant.stable_by_eigenvalues(controller));
  }
  goals.standstill->amplitude.clear();
  auto linear = PlantEvaluator::at_standstill(problem, hardest, goals, wind);
  EXPECT_GT(3.0 * linear.evaluate(controller, false).worst_ratio(), 1.01 * peaks[hardest]);
}

// A dead zone hides nothing: with an integral so fast that the linear loop is unstable, the loop is
// stable as long as errors are small, and refused all the same.
TEST(Verification, RefusesADeadZoneThatHidesAnUnstableLoop) {
  const TrackingProblem problem = reference::tracking_problem();
  Constraints goals;
  goals.sensitivity_peak = {3.0, 3.0, 3.0};
  goals.control_effort = 10.0;
  ASSERT_EQ(verify(problem, control::without_conditional_integral(conditional(1.0)), goals).failure,
            "");
  EXPECT_EQ(verify(problem, conditional(0.01), goals).failure, "");
  const auto hidden = verify(problem, conditional(20.0), goals);
  EXPECT_FALSE(hidden.passed);
  EXPECT_FALSE(hidden.stability.stable());
  EXPECT_EQ(assess(problem, conditional(20.0), goals).tuning.status, TuningStatus::unstable);
}

// Within the width the integral keeps what the last motion left.
TEST(StaticEncoderError, IsTheWidthOfAConditionalIntegral) {
  const TrackingProblem problem = reference::tracking_problem();
  Controller controller = conditional(0.02);
  const double held =
      static_encoder_error(problem, control::without_conditional_integral(controller));
  EXPECT_GT(held, 0.0);
  std::size_t k = 0;
  while (controller.structure.gains().at(k).symbol != "dzp") ++k;
  for (const double factor : {0.5, 2.0}) {
    controller.gains[k] = factor * held * problem.gear_ratio;
    EXPECT_NEAR(static_encoder_error(problem, controller), factor * held, 1e-12 * held);
    const auto ratio = static_error_constraint(controller, 1.0, problem.gear_ratio, held);
    EXPECT_NEAR(ratio.ratio, factor, 1e-12);
    for (const double slope : ratio.log_gradient) EXPECT_EQ(slope, 0.0);
  }
}

// Linear figures do not depend on the width: tuning takes the middle of its bounds.
TEST(Tune, TakesTheMiddleOfTheBoundsOfADeadZone) {
  const TrackingProblem problem = reference::tracking_problem();
  TuningOptions options;
  options.starts = 3;
  const auto structure = LoopStructure::named("PI+D").with_integral_width(0.07);
  const auto tuned = tune(problem, structure, {}, options);
  ASSERT_EQ(tuned.status, TuningStatus::optimal);
  EXPECT_DOUBLE_EQ(control::gain(tuned.controller, "dzp"), 0.07);
  for (const auto& bound : tuned.limiting_bounds)
    EXPECT_EQ(bound.gain.find("dead zone"), std::string::npos);
}

Constraints within(double static_encoder_error) {
  Constraints goals;
  goals.static_encoder_error = static_encoder_error;
  return goals;
}

// Its gradient is that of the product of both paths' gains.
TEST(StaticEncoderError, IsAConstraintOnTheLoopsStaticGain) {
  const TrackingProblem problem = reference::tracking_problem();
  const Controller loops = reference::lag_loops();
  const double limit = 2.0 * static_encoder_error(problem, loops);
  PlantEvaluator plant("", problem, within(limit), WindTable(problem));
  const auto ratio_of = [&](const Controller& controller) {
    const auto& ratios = plant.evaluate(controller, true).ratios;
    return *std::ranges::find(ratios, GoalKind::static_encoder_error, &NormalisedConstraint::kind);
  };
  const auto found = ratio_of(loops);
  EXPECT_NEAR(found.ratio, 0.5, 1e-12);
  for (std::size_t k = 0; k < loops.gains.size(); ++k) {
    Controller other = loops;
    other.gains[k] *= 1.001;
    EXPECT_NEAR(std::log(ratio_of(other).ratio / found.ratio) / std::log(1.001),
                found.log_gradient[k], 1e-9)
        << k;
  }
  EXPECT_NEAR(ratio_of(reference::lag_loops_as_state_space()).ratio, 0.5, 1e-9);
  EXPECT_EQ(ratio_of(reference::cautious_gains()).ratio, 0.0) << "integrals";
}

TEST(StaticEncoderError, IsMetByWhatIsTunedForIt) {
  const TrackingProblem problem = reference::tracking_problem();
  TuningOptions options;
  options.starts = 6;
  const auto structure = LoopStructure::named("LL+L");
  const auto free = tune(problem, structure, {}, options);
  ASSERT_EQ(free.status, TuningStatus::optimal);
  const Constraints goals = within(0.9 * static_encoder_error(problem, free.controller));
  EXPECT_FALSE(verify(problem, free.controller, goals).passed);
  const auto tuned = tune(problem, structure, goals, options);
  ASSERT_EQ(tuned.status, TuningStatus::optimal);
  EXPECT_TRUE(verify(problem, tuned.controller, goals).passed);
  EXPECT_NEAR(static_encoder_error(problem, tuned.controller), *goals.static_encoder_error,
              1e-5 * *goals.static_encoder_error);
  EXPECT_GT(tuned.soft_rms, free.soft_rms);
  EXPECT_TRUE(std::ranges::any_of(tuned.limits, [](const ActiveConstraint& limit) {
    return limit.goal.kind == GoalKind::static_encoder_error && limit.shadow_price > 0.0;
  }));
  // A limit of 0 is infeasible without an integral.
  EXPECT_NE(tune(problem, structure, within(0.0), options).status, TuningStatus::optimal);
}

TEST(StaticEncoderError, OfABadLimitIsRefused) {
  EXPECT_NO_THROW(validate(within(0.0)));
  EXPECT_THROW(validate(within(-1e-6)), InvalidInput);
  EXPECT_THROW(validate(within(HUGE_VAL)), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
