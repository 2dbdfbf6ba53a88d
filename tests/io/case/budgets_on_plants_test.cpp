// On how many plants a budget is met in the wind that it is needed up to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/design/ensembles/budgets_on_plants.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::io {
namespace {

using testing::ElementsAre;
using testing::Eq;
using testing::Optional;

TEST(BudgetsOnPlants, AreEvaluatedInTheirOwnWind) {
  const Case antenna = read_case(case_path("dss14-70m"));
  const auto problem = make_problem(antenna);
  const auto members = design::plant_members(mission_of(antenna), 1);
  const auto all = static_cast<int>(members.size());
  const control::Controller controller{control::LoopStructure::pi_with_lag(),
                                       {0.2, 0.8, 6.0, 0.2, 0.02}};
  const auto evaluated = design::evaluate(problem, members, controller, {}, 1);
  ASSERT_EQ(evaluated.stable, all);
  const double design_speed = problem.wind.mean_speed;
  design::PointingBudget budget;
  budget.rms = 1.0001 * evaluated.largest_rms;
  design::PointingBudget stronger = budget;
  budget.wind_speed = design_speed;
  stronger.wind_speed = 2.0 * design_speed;
  design::PointingBudget median = budget;
  median.rms = evaluated.median_rms;
  design::PointingBudget unneeded = budget;
  unneeded.wind_speed.reset();
  const std::vector<design::PointingBudget> budgets{budget, stronger, median, unneeded};
  const auto met = plants_within_budgets(problem, members, controller, {}, budgets, {}, 1);
  ASSERT_EQ(met.size(), budgets.size());
  EXPECT_THAT(met[0], Optional(all));
  // Gusts grow with the wind: none is met in twice the design's.
  EXPECT_THAT(met[1], Optional(0));
  EXPECT_NEAR(met[2].value_or(0), all / 2, 1);
  EXPECT_THAT(met[3], Eq(std::nullopt));
  // What the nonlinear antenna adds counts.
  EXPECT_THAT(
      plants_within_budgets(problem, members, controller, {}, {median}, {.factor = 100.0}, 1),
      ElementsAre(Optional(0)));
}

}  // namespace
}  // namespace boresight::io
