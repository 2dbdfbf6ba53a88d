#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/benchmark/rejection_benchmark.hpp>
#include <boresight/design/benchmark/rejection_response.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

using reference::cautious_gains;
using reference::mdeg;
using reference::tracking_problem;

TrackingProblem problem_with_torque_noise() {
  auto problem = tracking_problem();
  problem.noise.torque_rms = 0.5;
  return problem;
}

plant::StateSpace cautious_controller() {
  return control::to_state_space(cautious_gains());
}

TEST(RejectionBenchmark, IsTheEvaluatorsLoop) {
  const auto problem = tracking_problem();
  RejectionOptions options;
  options.budgets = {0.3 * mdeg, 0.8 * mdeg, 1e-6 * mdeg};
  const auto score = rejection_benchmark(problem, {}, cautious_controller(), options);
  ASSERT_TRUE(score.stable);
  EXPECT_EQ(score.rate_loop_stable, true);
  auto evaluator = make_evaluator(problem);
  const auto expected = evaluator.evaluate(cautious_gains(), false);
  const double n = problem.gear_ratio;
  EXPECT_NEAR(score.design_wind.wind_rms, std::sqrt(expected.wind_variance) / n,
              1e-5 * score.design_wind.wind_rms);
  EXPECT_NEAR(score.noise_rms, std::sqrt(expected.noise_variance) / n, 1e-5 * score.noise_rms);
  EXPECT_NEAR(score.control_effort, std::sqrt(expected.effort_variance),
              1e-5 * score.control_effort);
  const auto verification = verify(problem, cautious_gains(), Constraints{});
  for (std::size_t b = 0; b < 3; ++b) {
    ASSERT_TRUE(score.breaks.at(b).margins);
    const double peak = score.breaks.at(b).margins->sensitivity.magnitude;
    EXPECT_LE(peak, verification.peaks.at(b).upper * (1.0 + 1e-9));
    EXPECT_GT(peak, verification.peaks.at(b).lower * (1.0 - 1e-6));
  }
  EXPECT_NEAR(score.abscissa, verification.stability.closed_loop_abscissa, 1e-8);
  for (std::size_t i = 0; i < 3; ++i) {
    const double speed = wind_speed_limit(problem, evaluator, cautious_gains(),
                                          expected.noise_variance, options.budgets[i]);
    EXPECT_NEAR(score.budget_speeds[i], speed, 1e-4 * speed);
  }
}

TEST(RejectionBenchmark, SpectrumAndLyapunovAgree) {
  const auto problem = problem_with_torque_noise();
  const auto continuous = rejection_benchmark(problem, {}, cautious_controller());
  EXPECT_NEAR(continuous.lyapunov_rms, continuous.design_wind.boresight_rms,
              5e-3 * continuous.lyapunov_rms);
  const auto sampled =
      rejection_benchmark(problem, {}, control::sampled_controller(cautious_gains(), 0.02));
  EXPECT_NEAR(sampled.lyapunov_rms, sampled.design_wind.boresight_rms, 5e-3 * sampled.lyapunov_rms);
  // Half a hold and one sample are the continuous loop's dead time.
  EXPECT_NEAR(sampled.design_wind.boresight_rms, continuous.design_wind.boresight_rms,
              0.02 * continuous.design_wind.boresight_rms);
  EXPECT_NEAR(sampled.step.peak, continuous.step.peak, 0.02 * continuous.step.peak);
}

// An LQG of another module scores what that module says of it, and no better than the bound.
TEST(RejectionBenchmark, LqgScoresWhatThePointingLimitSays) {
  const auto problem = problem_with_torque_noise();
  const auto limit = pointing_limit(problem, {}, {}, {}, {.sample_time = 0.02});
  ASSERT_TRUE(limit.margin_limited);
  const auto& best = limit.margin_limited->design;
  const auto score = rejection_benchmark(problem, {}, best.controller);
  ASSERT_TRUE(score.stable);
  EXPECT_NEAR(std::exp(score.abscissa * 0.02), best.nominal.spectral_radius, 1e-9);
  EXPECT_NEAR(score.lyapunov_rms, best.nominal.boresight_rms, 1e-8 * best.nominal.boresight_rms);
  EXPECT_NEAR(score.design_wind.boresight_rms, best.nominal.boresight_rms,
              5e-3 * best.nominal.boresight_rms);
  EXPECT_NEAR(score.control_effort, best.nominal.control_effort,
              1e-3 * best.nominal.control_effort);
  ASSERT_TRUE(score.breaks[1].margins);
  EXPECT_NEAR(score.breaks[1].margins->sensitivity.magnitude, best.nominal.peak.magnitude,
              5e-3 * best.nominal.peak.magnitude);
  ASSERT_TRUE(score.reference && score.reference->min_rms_at_own_effort);
  EXPECT_NEAR(*score.reference->min_rms, limit.min_rms, 1e-9 * limit.min_rms);
  EXPECT_GE(score.lyapunov_rms, *score.reference->min_rms_at_own_effort);
}

TEST(RejectionBenchmark, MembersAreEvaluatedAsTheTunersAre) {
  const auto problem = tracking_problem();
  RejectionOptions options;
  options.members = reference_ensemble(problem, 1);
  options.members.resize(8);
  Constraints goals;
  goals.sensitivity_peak = {1.6, 1.5, 1.5};
  const auto score = rejection_benchmark(problem, goals, cautious_controller(), options);
  const auto expected = evaluate(problem, options.members, cautious_gains(), goals, 1);
  ASSERT_TRUE(score.ensemble);
  EXPECT_EQ(score.ensemble->stable, expected.stable);
  EXPECT_EQ(score.ensemble->within_constraints, expected.within_constraints);
  for (std::size_t i = 0; i < options.members.size(); ++i) {
    const auto& one = score.ensemble->members[i];
    const auto& other = expected.members[i];
    EXPECT_EQ(one.name, other.name);
    EXPECT_NEAR(one.boresight_rms, other.boresight_rms, 1e-4 * other.boresight_rms);
    EXPECT_NEAR(one.control_effort, other.control_effort, 1e-4 * other.control_effort);
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_NEAR(one.sensitivity_peaks.at(b), other.sensitivity_peaks.at(b),
                  1e-3 * other.sensitivity_peaks.at(b));
    }
  }
  options.threads = 3;
  const auto again = rejection_benchmark(problem, goals, cautious_controller(), options);
  for (std::size_t i = 0; i < options.members.size(); ++i) {
    EXPECT_EQ(again.ensemble->members[i].boresight_rms, score.ensemble->members[i].boresight_rms);
  }
}

TEST(RejectionBenchmark, LadderKnowsCoefficientModelAndSpeed) {
  auto problem = tracking_problem();
  RejectionOptions options;
  options.attitudes = {{"head on", 0.0}, {"twice", 0.2}};
  const auto score = rejection_benchmark(problem, {}, cautious_controller(), options);
  ASSERT_EQ(score.winds.size(), 7U * 5U);
  const auto find = [&](const std::string& attitude, plant::WindModel model, double speed) {
    for (const auto& wind : score.winds) {
      if (wind.attitude == attitude && wind.model == model && wind.mean_speed == speed) return wind;
    }
    return WindScore{};
  };
  const auto design = find("", plant::WindModel::coherence, 10.0);
  EXPECT_NEAR(design.boresight_rms, score.design_wind.boresight_rms, 1e-12);
  // Without a mean torque the gradient over the dish still turns it.
  const auto head_on = find("head on", plant::WindModel::coherence, 10.0);
  EXPECT_GT(head_on.wind_rms, 0.0);
  EXPECT_LT(head_on.wind_rms, design.wind_rms);
  const auto twice = find("twice", plant::WindModel::coherence, 10.0);
  EXPECT_NEAR(std::pow(twice.wind_rms, 2) - std::pow(head_on.wind_rms, 2),
              4.0 * (std::pow(design.wind_rms, 2) - std::pow(head_on.wind_rms, 2)),
              1e-9 * std::pow(twice.wind_rms, 2));
  problem.wind.model = plant::WindModel::uniform;
  problem.wind.mean_speed = 15.0;
  const auto other = rejection_benchmark(problem, {}, cautious_controller());
  EXPECT_NEAR(find("", plant::WindModel::uniform, 15.0).wind_rms, other.design_wind.wind_rms,
              1e-9 * other.design_wind.wind_rms);
  // Torque grows with the square of the speed and a little more: gusts are slower in little wind.
  EXPECT_GT(find("", plant::WindModel::uniform, 20.0).torque_rms,
            3.9 * find("", plant::WindModel::uniform, 10.0).torque_rms);
}

TEST(RejectionBenchmark, ComplianceLiesBelowItsBoundAndEndsAtItsStaticValue) {
  const auto problem = tracking_problem();
  const auto score = rejection_benchmark(problem, {}, cautious_controller());
  for (const auto& point : score.compliance) {
    EXPECT_LE(point.compliance, score.worst.upper * (1.0 + 1e-12));
  }
  EXPECT_GT(score.worst.frequency, 0.0);
  EXPECT_EQ(score.compliance.size(), compliance_frequencies().size());
  EXPECT_DOUBLE_EQ(score.compliance.front().frequency, 1e-3);
  // Two integrators: nothing is left but the bending.
  EXPECT_NEAR(score.static_compliance, score.flexure_compliance, 1e-8 * score.flexure_compliance);
  EXPECT_NEAR(score.compliance.front().compliance, score.static_compliance,
              0.2 * score.static_compliance);
}

TEST(RejectionBenchmark, UnstableLoopIsAResultWithoutNumbers) {
  auto controller = cautious_controller();
  controller.c *= 40.0;
  controller.d *= 40.0;
  const auto score = rejection_benchmark(tracking_problem(), {}, controller);
  EXPECT_FALSE(score.stable);
  EXPECT_GT(score.abscissa, 0.0);
  EXPECT_TRUE(score.compliance.empty());
  EXPECT_EQ(score.design_wind.boresight_rms, 0.0);
}

TEST(RejectionBenchmark, ControllerWithoutEncoderLeavesTheAntennaFree) {
  const auto rate_only = plant::subsystem(cautious_controller(), {"tachometer"}, {"valve_demand"});
  const auto score = rejection_benchmark(tracking_problem(), {}, rate_only);
  EXPECT_FALSE(score.stable);
}

TEST(RejectionBenchmark, ControllerOfTheEncoderAloneHasOneLoop) {
  const auto controller =
      plant::static_gain(Eigen::MatrixXd::Constant(1, 1, -0.05), {"encoder"}, {"valve_demand"});
  const auto score = rejection_benchmark(tracking_problem(), {}, controller);
  ASSERT_TRUE(score.stable);
  EXPECT_FALSE(score.rate_loop_stable);
  EXPECT_FALSE(score.breaks[0].margins);
  ASSERT_TRUE(score.breaks[1].margins && score.breaks[2].margins);
  EXPECT_NEAR(score.breaks[1].margins->sensitivity.magnitude,
              score.breaks[2].margins->sensitivity.magnitude, 1e-9);
}

TEST(RejectionBenchmark, LeavesOutWhatItIsToldTo) {
  RejectionOptions options;
  options.stop = [] { return true; };
  const auto score = rejection_benchmark(tracking_problem(), {}, cautious_controller(), options);
  EXPECT_TRUE(score.stable);
  EXPECT_GT(score.step.peak, 0.0);
  EXPECT_THAT(score.left_out, testing::ElementsAre("ladder of winds", "wind speeds of the budgets",
                                                   "ensemble", "best that any controller can do"));
  EXPECT_TRUE(score.winds.empty());
}

}  // namespace
}  // namespace boresight::design
