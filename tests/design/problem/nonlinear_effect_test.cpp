#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <boresight/design/problem/nonlinear_effect.hpp>

namespace boresight::design {
namespace {

// sqrt(0.4^2 + 0.34^2 / 2); a budget of 0.527 leaves sqrt(0.527^2 - 0.34^2 / 2) to the wind.
TEST(NonlinearEffect, AddsTheLimitCycleInQuadrature) {
  const NonlinearEffect effect{1.0, 0.34};
  EXPECT_NEAR(effect.rms(0.4), 0.4666905, 1e-7);
  EXPECT_NEAR(effect.linear_limit(0.527), 0.4689659, 1e-7);
  EXPECT_TRUE(within_budget(effect.rms(0.4), 0.527));
  // The largest limit cycle that leaves 0.4 to the wind.
  const double largest = std::sqrt(2.0 * (0.527 * 0.527 - 0.4 * 0.4));
  EXPECT_TRUE(within_budget(NonlinearEffect{1.0, largest}.rms(0.4), 0.527));
  EXPECT_FALSE(within_budget(NonlinearEffect{1.0, 1.001 * largest}.rms(0.4), 0.527));
}

TEST(NonlinearEffect, LimitIsTheInverseOfItsRms) {
  for (const double factor : {0.8, 1.0, 1.3}) {
    for (const double amplitude : {0.0, 0.2, 0.7}) {
      const NonlinearEffect effect{factor, amplitude};
      EXPECT_NEAR(effect.rms(effect.linear_limit(0.527)), 0.527, 1e-12) << factor << amplitude;
    }
  }
}

TEST(NonlinearEffect, LeavesNothingWhereTheLimitCycleOrALostRunTakesAll) {
  EXPECT_EQ((NonlinearEffect{1.0, std::numbers::sqrt2 * 0.527}.linear_limit(0.527)), 0.0);
  EXPECT_EQ((NonlinearEffect{std::numeric_limits<double>::infinity(), 0.0}.linear_limit(0.527)),
            0.0);
}

TEST(NonlinearEffect, HoldsBudgetsAgainstTheLargerRms) {
  EXPECT_EQ((NonlinearEffect{0.9, 0.1}.for_budgets().factor), 1.0);
  EXPECT_EQ((NonlinearEffect{1.1, 0.1}.for_budgets().factor), 1.1);
  EXPECT_EQ((NonlinearEffect{0.9, 0.1}.for_budgets().amplitude), 0.1);
}

TEST(NonlinearEffect, DoesNotChangeWithTheUnitOfAngle) {
  for (const double unit : {1e-6, 1e6}) {
    const NonlinearEffect effect{1.2, 0.3 * unit};
    EXPECT_NEAR(effect.rms(0.4 * unit) / unit, (NonlinearEffect{1.2, 0.3}.rms(0.4)), 1e-12);
  }
}

}  // namespace
}  // namespace boresight::design
