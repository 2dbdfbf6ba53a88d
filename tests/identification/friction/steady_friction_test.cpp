#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/identification/friction/steady_friction.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

std::vector<SteadyFriction> tests_of(const plant::FrictionCurve& curve,
                                     const std::vector<double>& rates) {
  std::vector<SteadyFriction> tests;
  for (const double rate : rates) {
    tests.push_back(
        {rate, rate == 0.0 ? curve.breakaway_torque : plant::friction_torque(curve, rate)});
  }
  return tests;
}

const plant::FrictionCurve truth{30.0, 45.0, 6.0, 0.0, 1.0, 0.25};

TEST(SteadyFriction, FindsTheCurveThatTheTestsLieOn) {
  const auto fit = fit_steady_friction(tests_of(truth, {0.0, 2.0, 4.0, 8.0, 20.0, 60.0, 120.0}));
  EXPECT_NEAR(fit.curve.coulomb_torque, 30.0, 1e-3);
  EXPECT_NEAR(fit.curve.breakaway_torque, 45.0, 1e-3);
  EXPECT_NEAR(fit.curve.stribeck_rate, 6.0, 1e-3);
  EXPECT_NEAR(fit.curve.viscous_friction, 0.25, 1e-4);
  EXPECT_EQ(fit.curve.saturating_torque, 0.0);
  EXPECT_NEAR(fit.scatter, 0.0, 1e-3);
  // In any order and any unit.
  auto other = tests_of(truth, {120.0, 8.0, 0.0, 60.0, 4.0, 2.0, 20.0});
  for (auto& test : other) {
    test.rate *= 2.0;
    test.torque *= 3.0;
  }
  const auto scaled = fit_steady_friction(other);
  EXPECT_NEAR(scaled.curve.stribeck_rate, 2.0 * fit.curve.stribeck_rate, 1e-3);
  EXPECT_NEAR(scaled.curve.coulomb_torque, 3.0 * fit.curve.coulomb_torque, 1e-3);
  EXPECT_NEAR(scaled.curve.viscous_friction, 1.5 * fit.curve.viscous_friction, 1e-4);
}

TEST(SteadyFriction, SaysNoMoreThanTheTestsDo) {
  // One test: its torque. Two: the line through them. With one at rest: what breaks away.
  const auto one = fit_steady_friction({{10.0, 40.0}}).curve;
  EXPECT_NEAR(one.coulomb_torque, 40.0, 1e-12);
  EXPECT_EQ(one.breakaway_torque, one.coulomb_torque);
  EXPECT_EQ(one.viscous_friction, 0.0);
  const auto line = fit_steady_friction({{10.0, 40.0}, {30.0, 50.0}}).curve;
  EXPECT_NEAR(line.coulomb_torque, 35.0, 1e-9);
  EXPECT_NEAR(line.viscous_friction, 0.5, 1e-9);
  EXPECT_EQ(line.breakaway_torque, line.coulomb_torque);
  const auto rest = fit_steady_friction({{0.0, 60.0}, {10.0, 40.0}, {30.0, 50.0}}).curve;
  EXPECT_NEAR(rest.breakaway_torque, 60.0, 1e-9);
  EXPECT_NEAR(plant::friction_torque(rest, 10.0), 40.0, 1e-9);
  EXPECT_NEAR(plant::friction_torque(rest, 30.0), 50.0, 1e-9);
  EXPECT_NEAR(rest.stribeck_rate, 10.0 / 3.0, 1e-9);
}

TEST(SteadyFriction, KeepsToWhatFrictionCanBe) {
  // A line that falls has no viscous part below 0, and breakaway below the level is the level.
  const auto falling = fit_steady_friction({{10.0, 50.0}, {30.0, 40.0}}).curve;
  EXPECT_EQ(falling.viscous_friction, 0.0);
  EXPECT_NEAR(falling.coulomb_torque, 45.0, 1e-9);
  const auto low = fit_steady_friction({{0.0, 20.0}, {10.0, 40.0}, {30.0, 40.0}, {60.0, 40.0}});
  EXPECT_GE(low.curve.breakaway_torque, low.curve.coulomb_torque);
  EXPECT_GT(low.scatter, 1.0);
  // No hump at rest of whatever width comes nearer to these than their line, 25 + 0.6 x, does: with
  // squares of 420 and two degrees of freedom, as no Stribeck rate is fitted.
  const auto scattered =
      fit_steady_friction({{10.0, 30.0}, {20.0, 30.0}, {30.0, 60.0}, {40.0, 40.0}});
  EXPECT_EQ(scattered.curve.breakaway_torque, scattered.curve.coulomb_torque);
  EXPECT_NEAR(scattered.curve.coulomb_torque, 25.0, 1e-9);
  EXPECT_NEAR(scattered.scatter, std::sqrt(210.0), 1e-9);
}

// Of the truth, with the test at 9 rad/s rounded to `torque`: the line through the last two tests
// and the one at rest are exact.
std::vector<SteadyFriction> one_rounded(double torque, double leeway) {
  auto tests = tests_of(truth, {0.0, 9.0, 60.0, 120.0});
  tests[1].torque = torque;
  tests[1].leeway = leeway;
  return tests;
}

constexpr double grid = 1e-4;  // what the search's last step leaves of a number

// The rate at which the hump of 15 N m is that at 9 rad/s.
double rate_of(double bump) {
  return 9.0 / std::sqrt(std::log(15.0 / bump));
}

TEST(SteadyFrictionIntervals, HoldTheTruthBehindARoundedTorque) {
  const double exact = plant::friction_torque(truth, 9.0), rounded = 33.8;
  ASSERT_NEAR(exact, rounded, 0.05);
  const auto tests = one_rounded(rounded, 0.05);
  EXPECT_EQ(steady_friction_freedom(tests), 0);
  const auto intervals = steady_friction_intervals(tests);
  ASSERT_TRUE(intervals.stribeck_rate);
  const FrictionInterval& rate = *intervals.stribeck_rate;
  const double line = 30.0 + 0.25 * 9.0;
  EXPECT_NEAR(rate.minimum, rate_of(rounded - 0.05 - line), 1e-3);
  EXPECT_NEAR(rate.largest, rate_of(rounded + 0.05 - line), 1e-3);
  EXPECT_FALSE(rate.min_open || rate.largest_open);
  EXPECT_EQ(rate.moved_most_by, 1U);
  EXPECT_GT(std::abs(fit_steady_friction(tests).curve.stribeck_rate - 6.0), 0.02);
  EXPECT_LT(rate.minimum, 6.0);
  EXPECT_GT(rate.largest, 6.0);
  // That test tells nothing of the rest.
  EXPECT_NEAR(intervals.breakaway_torque.minimum, 45.0, grid);
  EXPECT_NEAR(intervals.breakaway_torque.largest, 45.0, grid);
  EXPECT_NEAR(intervals.coulomb_torque.minimum, 30.0, grid);
  EXPECT_NEAR(intervals.coulomb_torque.largest, 30.0, grid);
  // And without leeway nothing moves.
  const auto fixed = steady_friction_intervals(one_rounded(rounded, 0.0));
  ASSERT_TRUE(fixed.stribeck_rate);
  EXPECT_EQ(fixed.stribeck_rate->minimum, fixed.stribeck_rate->largest);
  EXPECT_FALSE(fixed.stribeck_rate->moved_most_by);
}

TEST(SteadyFrictionIntervals, MoveTheLineByTheTestsThatItGoesThrough) {
  auto tests = tests_of(truth, {0.0, 9.0, 60.0, 120.0});
  tests[0].leeway = 0.5;
  tests[2].leeway = 0.1;
  const auto intervals = steady_friction_intervals(tests);
  // The line through 45 -+ 0.1 at 60 and 60 at 120 begins at 30 -+ 0.2.
  EXPECT_NEAR(intervals.coulomb_torque.minimum, 29.8, grid);
  EXPECT_NEAR(intervals.coulomb_torque.largest, 30.2, grid);
  EXPECT_EQ(intervals.coulomb_torque.moved_most_by, 2U);
  EXPECT_NEAR(intervals.viscous_friction.minimum, 0.25 - 0.1 / 60.0, grid);
  EXPECT_NEAR(intervals.viscous_friction.largest, 0.25 + 0.1 / 60.0, grid);
  EXPECT_NEAR(intervals.breakaway_torque.minimum, 44.5, grid);
  EXPECT_NEAR(intervals.breakaway_torque.largest, 45.5, grid);
  EXPECT_EQ(intervals.breakaway_torque.moved_most_by, 0U);
}

TEST(SteadyFrictionIntervals, AreOpenWhereAFitRunsToTheEndOfItsSearch) {
  // 2 N m less at 9 rad/s is below the line through the others: no rate is low enough.
  const auto low = steady_friction_intervals(one_rounded(33.8, 2.0)).stribeck_rate;
  ASSERT_TRUE(low);
  EXPECT_TRUE(low->min_open);
  EXPECT_NEAR(low->minimum, 3.0, 1e-9);
  EXPECT_FALSE(low->largest_open);
  // Also where no torque need be moved for it.
  const auto at_bound = steady_friction_intervals(one_rounded(31.0, 0.1)).stribeck_rate;
  ASSERT_TRUE(at_bound);
  EXPECT_TRUE(at_bound->min_open);
  EXPECT_EQ(at_bound->minimum, at_bound->largest);
  // Without a hump at rest any rate will do: scattered tests, of which the first may show one.
  std::vector<SteadyFriction> scattered{
      {10.0, 30.0, 20.0}, {20.0, 30.0}, {30.0, 60.0}, {40.0, 40.0}};
  const auto any = steady_friction_intervals(scattered).stribeck_rate;
  ASSERT_TRUE(any);
  EXPECT_TRUE(any->min_open && any->largest_open);
  EXPECT_NEAR(any->minimum, 10.0 / 3.0, 1e-9);
  EXPECT_NEAR(any->largest, 40.0, 1e-9);
  EXPECT_FALSE(any->moved_most_by);
  scattered[0].leeway = 0.1;
  EXPECT_FALSE(steady_friction_intervals(scattered).stribeck_rate) << "no fit has a hump";
}

TEST(SteadyFrictionIntervals, CountTheNumbersThatTestsAreAskedFor) {
  EXPECT_EQ(steady_friction_freedom(tests_of(truth, {0.0, 2.0, 4.0, 8.0, 20.0, 60.0, 120.0})), 3);
  EXPECT_EQ(steady_friction_freedom(tests_of(truth, {0.0, 10.0, 30.0})), 0);
  EXPECT_EQ(steady_friction_freedom(tests_of(truth, {5.0, 10.0, 30.0})), 1);
  EXPECT_EQ(steady_friction_freedom(tests_of(truth, {10.0})), 0);
  // A number at its bound was asked for as well.
  EXPECT_EQ(steady_friction_freedom(one_rounded(31.0, 0.1)), 0);
  EXPECT_FALSE(steady_friction_intervals(tests_of(truth, {0.0, 10.0, 30.0})).stribeck_rate);
}

TEST(SteadyFrictionIntervals, KeepMovedTorquesAboveZero) {
  const auto intervals = steady_friction_intervals({{10.0, 1.0, 5.0}});
  EXPECT_EQ(intervals.coulomb_torque.minimum, 0.0);
  EXPECT_NEAR(intervals.coulomb_torque.largest, 6.0, 1e-12);
  EXPECT_THROW(steady_friction_intervals({{10.0, 1.0, -1.0}}), InvalidInput);
  EXPECT_THROW(steady_friction_intervals({{10.0, 1.0, std::numeric_limits<double>::infinity()}}),
               InvalidInput);
  EXPECT_THROW(steady_friction_intervals({}), InvalidInput);
  EXPECT_THROW(steady_friction_freedom({}), InvalidInput);
}

TEST(SteadyFriction, RefusesWhatIsNoTest) {
  EXPECT_THROW(fit_steady_friction({}), InvalidInput);
  EXPECT_THROW(fit_steady_friction({{0.0, 40.0}}), InvalidInput);
  EXPECT_THROW(fit_steady_friction({{1.0, 40.0}, {1.0, 41.0}}), InvalidInput);
  EXPECT_THROW(fit_steady_friction({{-1.0, 40.0}}), InvalidInput);
  EXPECT_THROW(fit_steady_friction({{1.0, std::numeric_limits<double>::quiet_NaN()}}),
               InvalidInput);
}

}  // namespace
}  // namespace boresight::identification
