#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/design/studies/error_budget.hpp>

namespace boresight::design {
namespace {

Design design_of(double wind, double noise) {
  Design design;
  design.wind_rms = wind;
  design.noise_rms = noise;
  design.boresight_rms = std::hypot(wind, noise);
  design.tuning.controller = reference::cautious_gains();
  return design;
}

TEST(ErrorBudget, SumsToTheSimulatedRmsAndTheLimitCycleInQuadrature) {
  const auto problem = reference::tracking_problem();
  TimeDomainStudy in_time;
  in_time.result.wind.boresight_rms = 13.0;
  LimitCycleResult rest;
  rest.limit_cycle = true;
  rest.boresight_amplitude = 2.0;
  in_time.result.limit_cycles = {rest};
  const auto budget = error_budget(problem, design_of(3.0, 4.0), &in_time);
  EXPECT_DOUBLE_EQ(budget.wind, 3.0);
  EXPECT_DOUBLE_EQ(budget.noise, 4.0);
  EXPECT_DOUBLE_EQ(budget.nonlinearities, 12.0);
  EXPECT_DOUBLE_EQ(budget.limit_cycle, std::numbers::sqrt2);
  EXPECT_NEAR(budget.total * budget.total, 13.0 * 13.0 + 2.0, 1e-12);
  // The angle is integrated: what is left is the flexure.
  EXPECT_NEAR(budget.static_error / std::abs(static_bending(problem)), 1.0, 1e-5);
}

TEST(ErrorBudget, TakesTheExpectedRmsBeforeThatOfOneRecord) {
  TimeDomainStudy in_time;
  in_time.result.wind.boresight_rms = 13.0;
  in_time.rms.emplace();
  in_time.rms->rms.value = std::sqrt(26.0);
  const auto budget = error_budget(reference::tracking_problem(), design_of(3.0, 4.0), &in_time);
  EXPECT_NEAR(budget.nonlinearities, 1.0, 1e-12);
  EXPECT_NEAR(budget.total, std::sqrt(26.0), 1e-12);
}

TEST(ErrorBudget, HasNoNonlinearPartWithoutASimulationAboveTheLinearRms) {
  const auto problem = reference::tracking_problem();
  TimeDomainStudy in_time;
  in_time.result.wind.boresight_rms = 4.9;
  EXPECT_EQ(error_budget(problem, design_of(3.0, 4.0), &in_time).nonlinearities, 0.0);
  in_time.result.wind.boresight_rms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_budget(problem, design_of(3.0, 4.0), &in_time).total, 5.0);
  const auto linear = error_budget(problem, design_of(3.0, 4.0), nullptr);
  EXPECT_EQ(linear.total, 5.0);
  EXPECT_EQ(linear.limit_cycle, 0.0);
}

}  // namespace
}  // namespace boresight::design
