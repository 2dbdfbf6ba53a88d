#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/step_characteristics.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/tuning/tuner.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using control::LoopStructure;
using testing::HasSubstr;
using testing::ThrowsMessage;

TuningOptions quick(std::uint64_t seed = 1) {
  TuningOptions options;
  options.starts = 8;
  options.seed = seed;
  return options;
}

// A coarse grid, for what does not ask for digits.
TrackingProblem coarse_problem() {
  TrackingProblem problem = reference::tracking_problem();
  problem.points_per_decade = 60;
  return problem;
}

TuningOptions coarse(std::uint64_t seed = 1) {
  TuningOptions options = quick(seed);
  options.starts = 3;
  options.evaluations_per_start = 60;
  return options;
}

TEST(Tune, MeetsEveryGoalOnTheReferenceAntenna) {
  const TrackingProblem problem = reference::tracking_problem();
  const Constraints goals;
  for (const auto& structure : {LoopStructure::pi(), LoopStructure::pi_with_lag()}) {
    const TuningResult result = tune(problem, structure, goals, quick());
    EXPECT_EQ(result.status, TuningStatus::optimal);
    EXPECT_LE(result.worst_constraint, 1.0 + 1e-9);
    EXPECT_FALSE(result.active_constraints.empty() && result.gains_at_bound.empty());
    const Verification verification = verify(problem, result.controller, goals);
    EXPECT_TRUE(verification.passed);
    for (const auto& peak : verification.peaks) EXPECT_LE(peak.upper, 2.0 * (1.0 + 1e-6));
    EXPECT_LE(std::sqrt(result.evaluation.effort_variance), 0.6 * (1.0 + 1e-9));
    EXPECT_LT(verification.rms_disagreement, 5e-3);
    for (std::size_t k = 0; k < result.controller.gains.size(); ++k) {
      const auto& description = control::gain_descriptions(structure)[k];
      EXPECT_GE(result.controller.gains[k], description.lower * (1.0 - 1e-12));
      EXPECT_LE(result.controller.gains[k], description.upper * (1.0 + 1e-12));
    }
  }
}

TEST(Tune, PassesItsVerificationInEveryWind) {
  for (const auto model :
       {plant::WindModel::uniform, plant::WindModel::vickery, plant::WindModel::coherence}) {
    for (const double speed : {5.0, 10.0, 20.0}) {
      TrackingProblem problem = reference::tracking_problem();
      problem.wind.model = model;
      problem.wind.mean_speed = speed;
      const auto result = tune(problem, LoopStructure::pi_with_lag(), {}, quick());
      const auto verification = verify(problem, result.controller, {});
      EXPECT_TRUE(verification.passed)
          << to_string(model) << " " << speed << " m/s: " << verification.rms_disagreement;
    }
  }
}

TEST(Tune, FindsTheSameRmsFromMostSeeds) {
  const TrackingProblem problem = reference::tracking_problem();
  std::vector<double> rms;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto result = tune(problem, LoopStructure::pi_with_lag(), {}, quick(seed));
    if (result.status == TuningStatus::optimal) {
      rms.push_back(std::sqrt(result.evaluation.boresight_variance()));
    }
  }
  ASSERT_GE(rms.size(), 5u);
  const double best = *std::min_element(rms.begin(), rms.end());
  EXPECT_GE(std::count_if(rms.begin(), rms.end(), [&](double r) { return r < 1.01 * best; }), 5);
}

TEST(Tune, WithTheLagIsNoWorseThanWithout) {
  // PI is PI with lag at an infinite corner; the search's bound of 300 rad/s costs little.
  const TrackingProblem problem = reference::tracking_problem();
  const auto without = tune(problem, LoopStructure::pi(), {}, quick());
  const auto with = tune(problem, LoopStructure::pi_with_lag(), {}, quick());
  EXPECT_LT(with.evaluation.boresight_variance(), 1.01 * without.evaluation.boresight_variance());
}

TEST(Tune, EndsAtALocalOptimum) {
  const TrackingProblem problem = reference::tracking_problem();
  const Constraints goals;
  const auto result = tune(problem, LoopStructure::pi_with_lag(), goals, quick());
  auto evaluator = make_evaluator(problem);
  const double best = evaluator.evaluate(result.controller, false).boresight_variance();
  for (std::size_t k = 0; k < result.controller.gains.size(); ++k) {
    for (const double factor : {0.99, 1.01}) {
      const auto& description = control::gain_descriptions(result.controller.structure)[k];
      control::Controller changed = result.controller;
      changed.gains[k] *= factor;
      if (changed.gains[k] < description.lower || changed.gains[k] > description.upper) continue;
      const auto evaluation = evaluator.evaluate(changed, false);
      const bool worse = evaluation.boresight_variance() >= best * (1.0 - 1e-6);
      EXPECT_TRUE(worse || worst_constraint(evaluation, goals) > 1.0)
          << description.name << " times " << factor << ": rms " << std::sqrt(best) << " -> "
          << std::sqrt(evaluation.boresight_variance());
    }
  }
}

// The same antenna with its time running faster and its torques larger.
TrackingProblem faster_and_stronger(TrackingProblem problem, double faster, double stronger) {
  const double inertia = stronger / (faster * faster), friction = stronger / faster;
  auto& drive = problem.plant.drive;
  drive.oil_stiffness *= stronger;
  drive.leakage_rate *= faster;
  drive.viscous_friction *= friction;
  drive.motor_inertia *= inertia;
  drive.valve_corner *= faster;
  drive.tachometer_corner *= faster;
  auto& structure = problem.plant.structure;
  structure.bull_gear_inertia *= inertia;
  structure.gear_stiffness *= stronger;
  structure.gear_damping *= friction;
  for (auto& mode : structure.modes) {
    mode.inertia *= inertia;
    mode.stiffness *= stronger;
    mode.damping *= friction;
  }
  problem.delay /= faster;
  problem.noise.tachometer_rms *= faster;
  problem.noise.torque_rms *= stronger;
  problem.noise.bandwidth *= faster;
  problem.wind.mean_speed *= faster;
  problem.wind.site.air_density *= inertia;
  problem.rms_band.lowest *= faster;
  problem.rms_band.highest *= faster;
  return problem;
}

TEST(Tune, FindsTheSameControllerInOtherUnitsOfTimeAndTorque) {
  constexpr double faster = 10.0, stronger = 10.0;
  const TrackingProblem problem = coarse_problem();
  Constraints goals;
  goals.control_effort *= faster;
  const auto usual = LoopStructure::named("DPF+C");
  const auto moved = usual.with_bounds_for({2.0 * faster, 0.4 * stronger / (faster * faster)});
  const auto slow = tune(problem, usual, {}, coarse());
  const auto fast = tune(faster_and_stronger(problem, faster, stronger), moved, goals, coarse());
  EXPECT_EQ(slow.status, TuningStatus::optimal);
  EXPECT_NEAR(fast.soft_rms / slow.soft_rms, 1.0, 1e-3);
  EXPECT_EQ(fast.gains_at_bound, slow.gains_at_bound);
  for (std::size_t k = 0; k < moved.gains().size(); ++k) {
    const double factor = moved.gains()[k].upper / usual.gains()[k].upper;
    EXPECT_NEAR(fast.controller.gains[k] / slow.controller.gains[k] / factor, 1.0, 0.02)
        << usual.gains()[k].symbol;
  }
}

TEST(Tune, GainsNothingByLessWind) {
  // The same controller serves a calmer wind better: the optimum there cannot be worse.
  TrackingProblem calm = coarse_problem();
  calm.wind.mean_speed = 7.0;
  const auto windy = tune(coarse_problem(), LoopStructure::pi(), {}, coarse());
  const auto less = tune(calm, LoopStructure::pi(), {}, coarse());
  EXPECT_LT(less.evaluation.boresight_variance(), windy.evaluation.boresight_variance());
}

TEST(Tune, SaysWhenGoalsAreOutOfReach) {
  for (const auto& goals :
       {Constraints{{1.001, 1.001, 1.001}, 0.6}, Constraints{{2.0, 2.0, 2.0}, 1e-6}}) {
    const auto result = tune(coarse_problem(), LoopStructure::pi_with_lag(), goals, coarse());
    EXPECT_EQ(result.status, TuningStatus::infeasible);
    EXPECT_GT(result.worst_constraint, 1.0);
    EXPECT_TRUE(result.evaluation.stable());
    EXPECT_EQ(result.controller.gains.size(), 5u);
  }
}

TEST(Tune, NeverCallsAControllerOptimalThatBreaksAGoal) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (const double peak : {1.2, 1.35, 1.5, 1.7}) {
      const Constraints goals{{peak, peak, peak}, 0.6};
      const auto result = tune(coarse_problem(), LoopStructure::pi(), goals, coarse(seed));
      auto evaluator = make_evaluator(coarse_problem());
      const double ratio = worst_constraint(evaluator.evaluate(result.controller, false), goals);
      EXPECT_EQ(result.status == TuningStatus::optimal, ratio <= 1.0 + 1e-9) << peak;
      EXPECT_NEAR(ratio, result.worst_constraint, 1e-6);
    }
  }
}

TEST(Tune, GivesTheSameBytesForTheSameSeed) {
  const auto once = tune(coarse_problem(), LoopStructure::pi_with_lag(), {}, coarse(3));
  const auto again = tune(coarse_problem(), LoopStructure::pi_with_lag(), {}, coarse(3));
  EXPECT_EQ(once.controller.gains, again.controller.gains);
  EXPECT_EQ(once.evaluation.wind_variance, again.evaluation.wind_variance);
  EXPECT_EQ(once.evaluations, again.evaluations);
  EXPECT_EQ(once.active_constraints, again.active_constraints);
}

// As docs/case-file.md has it of [goals].
TEST(Tune, LimitsTheOvershootByThePhaseMargin) {
  const TrackingProblem problem = coarse_problem();
  const auto overshoot = [&](const char* structure, const Constraints& goals) {
    const auto tuned = tune(problem, LoopStructure::named(structure), goals, coarse());
    return control::step_characteristics(reference::command_to_encoder(problem, tuned.controller))
        .overshoot;
  };
  const auto at_margin = [&](const char* structure, double degrees) {
    Constraints goals;
    goals.phase_margin.fill(degrees * std::numbers::pi / 180.0);
    return overshoot(structure, goals);
  };
  EXPECT_NEAR(at_margin("PI", 45.0), 0.35, 0.02);
  EXPECT_NEAR(at_margin("DPF", 45.0), 0.24, 0.02);
  EXPECT_NEAR(at_margin("PI", 60.0), 0.20, 0.045);
  EXPECT_NEAR(at_margin("DPF", 60.0), 0.20, 0.045);
  EXPECT_LT(at_margin("PI", 75.0), 0.05);
  EXPECT_LT(at_margin("DPF", 75.0), 0.05);
  Constraints low_peak;
  low_peak.sensitivity_peak.fill(1.2);
  EXPECT_NEAR(overshoot("PI", low_peak), 0.25, 0.02);
  EXPECT_NEAR(overshoot("DPF", low_peak), 0.21, 0.02);
}

TEST(Evaluation, OfExtremeGainsIsANumber) {
  auto evaluator = make_evaluator(coarse_problem());
  for (const auto& structure : {LoopStructure::pi(), LoopStructure::pi_with_lag()}) {
    const auto& descriptions = control::gain_descriptions(structure);
    // Every corner of the bounds.
    for (unsigned corner = 0; corner < (1u << descriptions.size()); ++corner) {
      control::Controller controller{structure, {}};
      for (std::size_t k = 0; k < descriptions.size(); ++k) {
        controller.gains.push_back((corner >> k & 1u) != 0 ? descriptions[k].upper
                                                           : descriptions[k].lower);
      }
      const auto evaluation = evaluator.evaluate(controller, true);
      EXPECT_TRUE(std::isfinite(evaluation.boresight_variance()));
      EXPECT_GT(evaluation.boresight_variance(), 0.0);
      EXPECT_TRUE(std::isfinite(evaluation.effort_variance));
      for (std::size_t k = 0; k < descriptions.size(); ++k) {
        EXPECT_TRUE(std::isfinite(evaluation.wind_log_gradient[k]));
        EXPECT_TRUE(std::isfinite(evaluation.noise_log_gradient[k]));
        EXPECT_TRUE(std::isfinite(evaluation.effort_log_gradient[k]));
        for (const auto& peaks : evaluation.peaks) {
          for (const auto& peak : peaks) {
            EXPECT_TRUE(std::isfinite(peak.magnitude) && std::isfinite(peak.log_gradient[k]));
          }
        }
      }
    }
  }
}

TEST(WorstConstraint, IsTheLargestQuantityOverItsLimit) {
  control::LoopEvaluation evaluation;
  evaluation.effort_variance = 0.09;
  evaluation.peaks[0].push_back({1.0, 1.5, {}});
  evaluation.peaks[2].push_back({1.0, 1.8, {}});
  evaluation.peaks[2].push_back({2.0, 1.2, {}});
  EXPECT_DOUBLE_EQ(worst_constraint(evaluation, {{2.0, 2.0, 2.0}, 0.6}), 0.9);
  EXPECT_DOUBLE_EQ(worst_constraint(evaluation, {{1.2, 2.0, 2.0}, 0.6}), 1.25);
  EXPECT_DOUBLE_EQ(worst_constraint(evaluation, {{2.0, 2.0, 2.0}, 0.1}), 3.0);
  EXPECT_DOUBLE_EQ(worst_constraint(evaluation, {{2.0, 0.5, 2.0}, 0.6}), 2.0);  // |S| reaches 1
  evaluation.unstable_rate_loop = 1;
  EXPECT_TRUE(std::isinf(worst_constraint(evaluation, {})));
}

TEST(Tune, RefusesOptionsBelowOne) {
  for (const auto member : {&TuningOptions::starts, &TuningOptions::evaluations_per_start}) {
    TuningOptions options;
    options.*member = 0;
    EXPECT_THAT(reference::Call([&] { tune(coarse_problem(), LoopStructure::pi(), {}, options); }),
                ThrowsMessage<InvalidInput>(HasSubstr("at least 1 starts and 1 evaluation")));
  }
}

}  // namespace
}  // namespace boresight::design
