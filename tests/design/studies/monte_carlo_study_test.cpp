#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "design/studies/fixed_controller.hpp"
#include <boresight/design/studies/monte_carlo_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

Mission mission_of_test() {
  Mission mission = reference::uncertain_mission();
  mission.bands = {{"X", 8.4e9, 0.03 * degree, ""}};
  PointingBudget loose, tight;
  loose.name = "loose";
  loose.rms = 1.0;
  tight.name = "tight";
  tight.rms = std::numeric_limits<double>::min();
  mission.budgets = {loose, tight};
  return mission;
}

control::Controller controller_of_test() {
  return reference::fixed_controller("PI", 1.0).design.tuning.controller;
}

// As each plant alone is evaluated.
double unstable_fraction(const Mission& mission, const PlantDistribution& distribution,
                         const control::Controller& controller, const MonteCarloOptions& options) {
  const MonteCarlo study = monte_carlo_of(mission, distribution, controller, options);
  MonteCarloEvaluator evaluate(study);
  int unstable = 0;
  for (std::uint64_t i = 0; i < study.plants; ++i)
    unstable += evaluate.evaluate(i).stable() ? 0 : 1;
  return static_cast<double>(unstable) / static_cast<double>(study.plants);
}

// What one plant is given is its sample's, and the summary holds every plant.
TEST(StudyMonteCarlo, EvaluatesTheControllerOnTheSamplesOfItsSeed) {
  const Mission mission = mission_of_test();
  const auto distribution = PlantDistribution::of_ranges(mission);
  const MonteCarloOptions options{.plants = 150, .seed = 7};
  const auto summary = study_monte_carlo(mission, distribution, controller_of_test(), options);
  EXPECT_FALSE(summary.interrupted);
  EXPECT_EQ(summary.plants, 150U);
  EXPECT_EQ(summary.stable + summary.unstable + summary.undecided, 150U);
  ASSERT_GT(summary.stable, 0U);
  EXPECT_EQ(summary.boresight_rms.random_samples, summary.stable);
  EXPECT_EQ(summary.inputs, distribution.inputs());
  EXPECT_FALSE(summary.retuned);

  const NotablePlant& worst = summary.worst.front();
  EXPECT_EQ(worst.outcome.boresight_rms, summary.boresight_rms.largest);
  EXPECT_EQ(worst.draw.values, distribution.draw(7, worst.index).values);
  MonteCarloEvaluator alone(monte_carlo_of(mission, distribution, controller_of_test(), options));
  const auto plant = linear_plant(changed(mission.antenna, changes_of(worst.draw)));
  EXPECT_EQ(alone.evaluate(plant, false).boresight_rms, worst.outcome.boresight_rms);
}

TEST(Instability, IsThatOfTheStudy) {
  const Mission mission = mission_of_test();
  const auto distribution = PlantDistribution::of_ranges(mission);
  const MonteCarloOptions options{.plants = 150, .seed = 3};
  control::Controller controller = controller_of_test();
  const double position_gain = controller.gains[3];
  // From the tuned gain to one far beyond the gain margin.
  for (const double factor : {1.0, 100.0}) {
    controller.gains[3] = factor * position_gain;
    const auto alone = instability(mission, distribution, controller, options);
    EXPECT_EQ(alone.value == 1.0, factor == 100.0) << factor;
    EXPECT_EQ(alone.value, unstable_fraction(mission, distribution, controller, options));
  }
}

// The same plants as the study's, with its effect; in the wind that a budget states.
TEST(SampledProbabilities, AreThoseOfTheStudyInEachBudgetsWind) {
  Mission mission = mission_of_test();
  const auto distribution = PlantDistribution::of_ranges(mission);
  const MonteCarloOptions options{.plants = 100, .seed = 5};
  const auto summary_of = [&] {
    return study_monte_carlo(mission, distribution, controller_of_test(), options);
  };
  const auto first = summary_of();
  const NonlinearEffect effect = first.effect.for_budgets();
  mission.budgets.front().rms =
      effect.rms(0.5 * (first.boresight_rms.minimum + first.boresight_rms.largest));
  const auto summary = summary_of();
  PointingBudget windy = mission.budgets.front();
  windy.wind_speed = 1.5 * mission.wind.mean_speed;
  const auto both = sampled_probabilities(mission, distribution, controller_of_test(),
                                          {mission.budgets.front(), windy}, effect, options);
  EXPECT_EQ(both.constraints_met.value, summary.all_constraints_met.value);
  EXPECT_EQ(both.constraints_met.lower, summary.all_constraints_met.lower);
  EXPECT_EQ(both.constraints_met.upper, summary.all_constraints_met.upper);
  const auto& found = both.budgets_met;
  ASSERT_EQ(found.size(), 2U);
  const EstimatedNumber& met = summary.budgets.front().met;
  EXPECT_GT(met.value, 0.0);
  EXPECT_LT(met.value, 1.0);
  EXPECT_EQ(found[0].value, met.value);
  EXPECT_EQ(found[0].lower, met.lower);
  EXPECT_EQ(found[0].upper, met.upper);
  EXPECT_LT(found[1].value, met.value);
  mission.wind.mean_speed *= 1.5;
  mission.budgets = {mission.budgets.front()};
  mission.budgets.front().wind_speed.reset();
  EXPECT_EQ(found[1].value, sampled_probabilities(mission, distribution, controller_of_test(),
                                                  mission.budgets, effect, options)
                                .budgets_met.front()
                                .value);
}

// As many plants meet a budget as have a linear rms below what the simulation leaves of it.
TEST(StudyMonteCarlo, EvaluatesBudgetsByTheSimulationOfItsController) {
  Mission mission = mission_of_test();
  const auto distribution = PlantDistribution::of_ranges(mission);
  const MonteCarloOptions options{.plants = 100, .seed = 1};
  const auto met_at = [&](const std::vector<double>& budgets) {
    mission.budgets.resize(budgets.size());
    for (std::size_t i = 0; i < budgets.size(); ++i) mission.budgets[i].rms = budgets[i];
    return study_monte_carlo(mission, distribution, controller_of_test(), options);
  };
  const auto loose = met_at({1.0});
  const NonlinearEffect effect = loose.effect.for_budgets();
  ASSERT_TRUE(std::isfinite(effect.factor));
  const double largest = loose.boresight_rms.largest, minimum = loose.boresight_rms.minimum;
  const double stable = static_cast<double>(loose.stable) / 100.0;
  const auto by_simulation =
      met_at({effect.rms(largest), 0.999 * effect.rms(largest), 0.999 * effect.rms(minimum)});
  EXPECT_EQ(by_simulation.budgets[0].met.value, stable);
  EXPECT_LT(by_simulation.budgets[1].met.value, stable);
  EXPECT_EQ(by_simulation.budgets[2].met.value, 0.0);
  mission.antenna.nonlinear.reset();
  const auto linear = met_at({largest});
  EXPECT_EQ(linear.effect.factor, 1.0);
  EXPECT_EQ(linear.budgets[0].met.value, stable);
}

TEST(StudyMonteCarlo, SaysHowProbableItIsThatABudgetIsMet) {
  const Mission mission = mission_of_test();
  const auto distribution = PlantDistribution::of_ranges(mission);
  const auto summary =
      study_monte_carlo(mission, distribution, controller_of_test(), {.plants = 100, .seed = 1});
  ASSERT_EQ(summary.budgets.size(), 2U);
  EXPECT_EQ(summary.budgets[0].budget.name, "loose");
  EXPECT_EQ(summary.budgets[0].met.value, static_cast<double>(summary.stable) / 100.0);
  EXPECT_EQ(summary.budgets[1].met.value, 0.0);
  ASSERT_EQ(summary.losses.size(), 1U);
  EXPECT_EQ(summary.losses[0].band.name, "X");
  EXPECT_GT(summary.losses[0].loss.minimum, 0.0);
  EXPECT_FALSE(summary.climate_rms);
}

TEST(StudyMonteCarlo, IsTheSameForAnyNumberOfThreads) {
  const Mission mission = mission_of_test();
  const auto distribution = PlantDistribution::of_ranges(mission);
  MonteCarloOptions options{.plants = 250, .seed = 3};
  const auto one = study_monte_carlo(mission, distribution, controller_of_test(), options);
  options.threads = 3;
  const auto three = study_monte_carlo(mission, distribution, controller_of_test(), options);
  EXPECT_EQ(one.stable, three.stable);
  EXPECT_EQ(one.boresight_rms.mean.value, three.boresight_rms.mean.value);
  EXPECT_EQ(one.boresight_rms.largest, three.boresight_rms.largest);
}

TEST(StudyMonteCarlo, EndsWithWhatItHas) {
  const Mission mission = mission_of_test();
  const auto distribution = PlantDistribution::of_ranges(mission);
  MonteCarloOptions options{.plants = 250, .seed = 3};
  options.interrupted = [] { return true; };
  EXPECT_THROW(study_monte_carlo(mission, distribution, controller_of_test(), options),
               Interrupted);
  MonteCarloRun run(monte_carlo_of(mission, distribution, controller_of_test(), options));
  run.work_on({1}, {});
  const auto summary = summarise(run, mission, distribution, options.seed, 1);
  EXPECT_TRUE(summary.interrupted);
  EXPECT_EQ(summary.plants, 100U);
  EXPECT_EQ(summary.plants_asked, 250U);
  EXPECT_GE(summary.worst.front().index, 100U);
}

}  // namespace
}  // namespace boresight::design
