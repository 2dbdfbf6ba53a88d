#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "design/studies/fixed_controller.hpp"
#include <boresight/design/studies/number_effects.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

MovedNumber moved_by(void (*move)(TrackingProblem&, double), double by) {
  const auto to = [=](double change) {
    return [=] {
      TrackingProblem problem = tracking_problem(reference::demo_mission());
      move(problem, change);
      return problem;
    };
  };
  return {to(-by), to(by)};
}

void denser_air(TrackingProblem& problem, double fraction) {
  problem.wind.site.air_density *= 1.0 + fraction;
}

void later(TrackingProblem& problem, double fraction) {
  problem.delay *= 1.0 + fraction;
}

void nothing(TrackingProblem& /*problem*/, double /*fraction*/) {}

void no_antenna(TrackingProblem& /*problem*/, double fraction) {
  if (fraction > 0.0) throw InvalidInput("no antenna");
}

control::Controller controller_of_test() {
  return reference::fixed_controller("PI", 1.0).design.tuning.controller;
}

// The wind's torque scales with the air's density, and the sensors' noise does not.
TEST(NumberEffects, AreWhatTheClosedLoopSays) {
  const auto problem = tracking_problem(reference::demo_mission());
  const auto alone = assess(problem, controller_of_test(), {});
  const auto effects = number_effects({moved_by(denser_air, 0.03)}, controller_of_test(), {},
                                      alone.boresight_rms, 10, 1);
  ASSERT_EQ(effects.size(), 1U);
  EXPECT_NEAR(effects[0].high_rms, std::hypot(1.03 * alone.wind_rms, alone.noise_rms),
              1e-4 * alone.boresight_rms);
  EXPECT_NEAR(effects[0].low_rms, std::hypot(0.97 * alone.wind_rms, alone.noise_rms),
              1e-4 * alone.boresight_rms);
}

TEST(NumberEffects, CombineInQuadratureOnEachSide) {
  const auto range = combined_range({{0, 0.97, 1.03}, {1, 1.04, 0.96}, {2, 1.2, 1.1}}, 1.0);
  EXPECT_NEAR(range.lower, 1.0 - std::hypot(0.03, 0.04), 1e-15);
  EXPECT_NEAR(range.upper, 1.0 + std::hypot(0.03, 0.04, 0.2), 1e-15);
  const auto unstable =
      combined_range({{0, 0.9, std::numeric_limits<double>::quiet_NaN()}, {1, 0.0, 1.0}}, 1.0);
  EXPECT_EQ(unstable.lower, 0.0);
  EXPECT_EQ(unstable.upper, std::numeric_limits<double>::infinity());
  const auto none = combined_range({}, 1.0);
  EXPECT_EQ(none.lower, 1.0);
  EXPECT_EQ(none.upper, 1.0);
}

TEST(NumberEffects, AreTheLargestFirstWithoutWhatChangesNothing) {
  const auto problem = tracking_problem(reference::demo_mission());
  const double rms = assess(problem, controller_of_test(), {}).boresight_rms;
  const std::vector<MovedNumber> numbers{moved_by(nothing, 0.1), moved_by(denser_air, 0.02),
                                         moved_by(no_antenna, 0.1), moved_by(denser_air, 0.2),
                                         moved_by(later, 0.1)};
  const auto effects = number_effects(numbers, controller_of_test(), {}, rms, 10, 2);
  ASSERT_GE(effects.size(), 2U);
  EXPECT_EQ(effects[0].number, 3U);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    EXPECT_NE(effects[i].number, 0U);
    EXPECT_NE(effects[i].number, 2U);
    if (i > 0) {
      EXPECT_GE(effects[i - 1].change(rms), effects[i].change(rms));
    }
  }
  // The same for one thread, and cut where asked.
  const auto few = number_effects(numbers, controller_of_test(), {}, rms, 1, 1);
  ASSERT_EQ(few.size(), 1U);
  EXPECT_EQ(few[0].number, effects[0].number);
  EXPECT_EQ(few[0].high_rms, effects[0].high_rms);
}

TEST(NumberEffect, IsWithoutBoundWhereTheLoopIsUnstable) {
  EXPECT_NEAR((NumberEffect{0, 0.9, 1.2}.change(1.0)), 0.2, 1e-12);
  const double unstable = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ((NumberEffect{0, 0.9, unstable}.change(1.0)), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace boresight::design
