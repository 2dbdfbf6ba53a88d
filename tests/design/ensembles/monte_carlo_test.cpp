#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/verification/linear_prediction.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight {
namespace {

using design::MonteCarlo;
using design::MonteCarloRun;
using design::PlantOutcome;
using design::StabilityBasis;

// The reference antenna with other oil, leakage and friction; wider, where requested, than its
// controller is stable on.
plant::AntennaPlant antenna_number(std::uint64_t index, double widening) {
  const auto fraction = [&](std::uint64_t input) {
    return static_cast<double>(numerics::splitmix64(3, 3 * index + input) >> 11U) * 0x1p-53;
  };
  auto plant = reference::antenna();
  plant.drive.oil_stiffness *= 0.8 + 0.5 * fraction(0);
  plant.drive.leakage_rate *= 1.0 - (0.7 + 0.29 * widening) * fraction(1);
  plant.drive.viscous_friction = 12.0 * (1.0 - widening) * fraction(2);
  return plant;
}

MonteCarlo study(std::uint64_t plants, double widening = 0.0) {
  return {.problem = reference::tracking_problem(),
          .controller = reference::cautious_gains(),
          .goals = {},
          .plants = plants,
          .plant = [=](std::uint64_t index) { return antenna_number(index, widening); }};
}

// A controller that is unstable on a fraction of the plants.
MonteCarlo hot_study(std::uint64_t plants) {
  MonteCarlo hot = study(plants, 1.0);
  hot.controller.gains[0] *= 1.1;
  hot.controller.gains[1] *= 0.9;
  return hot;
}

bool same(const PlantOutcome& one, const PlantOutcome& other) {
  return std::memcmp(&one, &other, sizeof one) == 0;
}

TEST(MonteCarlo, AgreesWithTheIndependentAssessment) {
  const MonteCarlo hot = hot_study(40);
  design::MonteCarloEvaluator evaluate(hot);
  int unstable = 0, broken = 0;
  for (std::uint64_t index = 0; index < hot.plants; ++index) {
    const auto outcome = evaluate.evaluate(index);
    auto problem = hot.problem;
    problem.plant = hot.plant(index);
    const auto verdict = control::stability(problem.plant, hot.controller, problem.delay,
                                            design::analysis_grid(problem));
    ASSERT_EQ(outcome.stable(), verdict.stable()) << index;
    if (!outcome.stable()) {
      ++unstable;
      EXPECT_EQ(outcome.stability_basis, StabilityBasis::unstable);
      EXPECT_EQ(outcome.confirmed, 1U);
      EXPECT_TRUE(std::isnan(outcome.boresight_rms));
      EXPECT_TRUE(std::isinf(outcome.worst_constraint));
      continue;
    }
    if (index % 8 != 0) continue;
    const auto assessed = design::assess(problem, hot.controller, hot.goals);
    EXPECT_NEAR(outcome.boresight_rms / assessed.boresight_rms, 1.0, 1e-4) << index;
    EXPECT_NEAR(outcome.control_effort / assessed.control_effort, 1.0, 1e-4) << index;
    for (std::size_t b = 0; b < 3; ++b) {
      const auto& peak = assessed.verification.peaks.at(b);
      EXPECT_NEAR(outcome.sensitivity_peaks.at(b) / peak.upper, 1.0, 1e-4) << index;
      const bool over = ((outcome.violated_constraints >> b) & 1U) != 0;
      EXPECT_EQ(over, peak.upper > hot.goals.sensitivity_peak.at(b)) << index;
      broken += over ? 1 : 0;
    }
  }
  EXPECT_GT(unstable, 2);
  EXPECT_LT(unstable, 38);
  EXPECT_GT(broken, 0);
}

TEST(MonteCarlo, IsTheSameForAnyThreadsOrderAndInterruption) {
  const MonteCarlo hot = hot_study(450);
  MonteCarloRun one(hot);
  one.work_on(one.missing_blocks(), {});
  EXPECT_EQ(one.blocks(), 5U);
  EXPECT_EQ(one.plants_done(), 450U);
  EXPECT_EQ(one.outcomes(4).size(), 50U);

  MonteCarloRun other(hot);
  other.work_on({3, 1}, {.threads = 3});
  EXPECT_EQ(other.plants_done(), 200U);
  std::atomic<int> asked{0};
  other.work_on(other.missing_blocks(), {.threads = 2, .stop = [&] { return ++asked > 130; }});
  EXPECT_LT(other.plants_done(), 450U);
  EXPECT_EQ(other.plants_done() % 50, 0U);
  int looked = 0;
  other.work_on(other.missing_blocks(), {.threads = 2, .watch = [&] { ++looked; }});
  EXPECT_GT(looked, 0);
  EXPECT_TRUE(other.missing_blocks().empty());
  for (std::uint64_t index = 0; index < hot.plants; ++index) {
    ASSERT_TRUE(same(one.outcome(index), other.outcome(index))) << index;
  }
  MonteCarloRun third(hot);
  third.put(2, one.outcomes(2));
  EXPECT_TRUE(third.whole(2));
  EXPECT_FALSE(third.whole(1));
  EXPECT_THROW(third.put(4, one.outcomes(2)), InvalidInput);
  EXPECT_THROW(third.put(5, one.outcomes(4)), InvalidInput);
}

TEST(MonteCarlo, ConfirmsASampleByEigenvalues) {
  MonteCarlo calm = study(100);
  calm.confirm_every = 10;
  MonteCarloRun run(calm);
  run.work_on(run.missing_blocks(), {});
  for (std::uint64_t index = 0; index < calm.plants; ++index) {
    const auto& outcome = run.outcome(index);
    EXPECT_TRUE(index % 10 != 0 || outcome.confirmed != 0) << index;
    EXPECT_EQ(outcome.confirmed == 0,
              outcome.stability_basis == StabilityBasis::stable_by_encirclements)
        << index;
    EXPECT_EQ(outcome.contradicted, 0U);
  }
}

TEST(MonteCarlo, OfAStateSpaceCountsItsOneLoopAndRetunesNothing) {
  const control::Controller loops = reference::lag_loops();
  MonteCarlo states = study(4);
  states.controller = control::state_space_controller(
      "sampled", plant::subsystem(control::sampled_controller(loops, 0.02),
                                  {"tachometer", "encoder"}, {"valve_demand"}));
  EXPECT_THAT(design::goals_applied(states.goals, states.controller),
              testing::ElementsAre(false, true, false, true));
  EXPECT_THAT(design::goals_applied(states.goals, loops), testing::Each(true));
  states.goals.sensitivity_peak = {1.01, 3.0, 1.01};
  const auto outcome = design::MonteCarloEvaluator(states).evaluate(0);
  EXPECT_TRUE(outcome.stable());
  EXPECT_EQ(outcome.violated_constraints & 0b101U, 0U);
  EXPECT_GT(outcome.sensitivity_peaks[1], 1.01);
  // Nor do the loops that it does not have count for the worst constraint.
  EXPECT_EQ(outcome.worst_constraint,
            std::max(outcome.sensitivity_peaks[1] / 3.0,
                     outcome.control_effort / states.goals.control_effort));
  states.retune = true;
  EXPECT_THROW(design::MonteCarloEvaluator{states}, InvalidInput);
}

TEST(MonteCarlo, TellsWhichGoalsBreak) {
  MonteCarlo windy = study(1);
  windy.goals.phase_margin = {std::nullopt, 0.5, std::nullopt};
  windy.goals.bandwidth = 1e-3;
  windy.goals.gust_torque = 1e4;
  EXPECT_THAT(
      design::goal_names(windy.goals),
      testing::ElementsAre("sensitivity peak at rate loop alone",
                           "sensitivity peak at valve command", "sensitivity peak at position loop",
                           "noise-driven control effort", "phase margin at valve command",
                           "bandwidth at position loop", "motor torque in gusts"));
  EXPECT_EQ(design::MonteCarloEvaluator(windy).evaluate(0).violated_constraints, 0U);
  windy.goals.phase_margin = {std::nullopt, 3.0, std::nullopt};
  windy.goals.control_effort = 1e-6;
  windy.goals.gust_torque = 1e-3;
  const auto outcome = design::MonteCarloEvaluator(windy).evaluate(0);
  EXPECT_EQ(outcome.violated_constraints, 0b1011000U);
  EXPECT_GT(outcome.worst_constraint, 1e4);
}

// On each plant by its own leakage and oil stiffness.
TEST(MonteCarlo, ComparesTheStaticErrorOfEachPlantWithItsLimit) {
  MonteCarlo leaky = study(20);
  leaky.controller = reference::lag_loops();
  std::vector<double> errors;
  for (std::uint64_t index = 0; index < leaky.plants; ++index) {
    design::TrackingProblem problem = leaky.problem;
    problem.plant = leaky.plant(index);
    errors.push_back(design::static_encoder_error(problem, leaky.controller));
  }
  const double limit = 0.5 * (std::ranges::min(errors) + std::ranges::max(errors));
  leaky.goals.static_encoder_error = limit;
  EXPECT_EQ(design::goal_names(leaky.goals).back(), "static encoder error");
  design::MonteCarloEvaluator evaluator(leaky);
  for (std::uint64_t index = 0; index < leaky.plants; ++index) {
    const auto outcome = evaluator.evaluate(index);
    ASSERT_TRUE(outcome.stable());
    EXPECT_EQ((outcome.violated_constraints >> 4U) & 1U, errors[index] > limit ? 1U : 0U) << index;
  }
}

TEST(MonteCarlo, RetunesEachPlantToNoMoreThanTheFixedController) {
  MonteCarlo calm = study(4);
  // A controller with fixed gains that meets the goals and is far from the best.
  calm.retune = true;
  MonteCarloRun run(calm);
  run.work_on(run.missing_blocks(), {.threads = 2});
  for (std::uint64_t index = 0; index < calm.plants; ++index) {
    const auto& outcome = run.outcome(index);
    EXPECT_EQ(outcome.violated_constraints, 0U);
    EXPECT_LT(outcome.retuned_rms, outcome.boresight_rms) << index;
    EXPECT_GT(outcome.retuned_rms, 0.1 * outcome.boresight_rms) << index;
  }
  calm.retune = false;
  EXPECT_TRUE(std::isnan(design::MonteCarloEvaluator(calm).evaluate(0).retuned_rms));
}

TEST(MonteCarlo, SaysWhichPlantFailed) {
  MonteCarlo broken = study(300);
  broken.plant = [](std::uint64_t index) {
    auto plant = antenna_number(index, 0.0);
    if (index == 123) plant.drive.oil_stiffness = std::nan("");
    return plant;
  };
  MonteCarloRun run(broken);
  EXPECT_THAT(reference::Call([&] { run.work_on(run.missing_blocks(), {.threads = 2}); }),
              testing::ThrowsMessage<NumericalFailure>(testing::HasSubstr("plant 123: ")));
  EXPECT_FALSE(run.whole(1));
  EXPECT_THROW(MonteCarloRun(study(0)), InvalidInput);
  MonteCarlo none = study(1);
  none.plant = nullptr;
  EXPECT_THROW(MonteCarloRun{none}, InvalidInput);
  MonteCarlo never = study(1);
  never.confirm_every = 0;
  EXPECT_THROW(MonteCarloRun{never}, InvalidInput);
}

}  // namespace
}  // namespace boresight
