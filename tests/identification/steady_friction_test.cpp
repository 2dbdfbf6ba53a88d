#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/identification/steady_friction.hpp>
#include <boresight/plant/error.hpp>

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
