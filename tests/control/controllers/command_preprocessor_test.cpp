#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include <boresight/control/controllers/command_preprocessor.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;

constexpr double sample_time = 0.02;
constexpr CommandLimits limits{0.25, 0.2};  // of any unit

// Samples until the target is reached and held; -1 if not within `maximum`.
int samples_to_reach(CommandPreprocessor& command, double target, int maximum = 20000) {
  for (int k = 1; k <= maximum; ++k) {
    command.advance(target);
    if (command.now().angle == target && command.now().rate == 0.0) return k;
  }
  return -1;
}

TEST(CommandPreprocessor, KeepsToItsLimitsAndEndsExactlyOnTheTarget) {
  reference::RandomNumbers random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const double target = random.uniform(-1.0, 1.0) * random.log_uniform(1e-9, 10.0);
    CommandPreprocessor command(limits, sample_time);
    double furthest = 0.0;
    CommandSample before = command.now();
    int k = 0;
    for (; k < 5000 && !(command.now().angle == target && command.now().rate == 0.0); ++k) {
      const CommandSample now = command.advance(target);
      EXPECT_LE(std::abs(now.rate), limits.rate);
      EXPECT_LE(std::abs(now.acceleration), limits.acceleration * (1.0 + 1e-9));
      EXPECT_NEAR(now.angle, before.angle + 0.5 * sample_time * (before.rate + now.rate),
                  1e-14 * (1.0 + std::abs(target)));
      EXPECT_NEAR(now.rate, before.rate + sample_time * now.acceleration, 1e-15);
      furthest = std::max(furthest, now.angle * (target > 0.0 ? 1.0 : -1.0));
      before = now;
    }
    ASSERT_LT(k, 5000) << target;
    EXPECT_LE(furthest, std::abs(target)) << "passes the target";
    const double minimum = min_move_time(limits, target);
    EXPECT_GE(sample_time * k, minimum * (1.0 - 1e-12)) << target;
    EXPECT_LE(sample_time * k, minimum + 2.0 * sample_time) << target;
  }
}

// Up, level and down parts that are whole samples: the bang-bang motion itself.
TEST(CommandPreprocessor, TakesTheLeastTimeWhereThatIsWholeSamples) {
  const double step = limits.acceleration * sample_time;
  for (const int up : {1, 7, 50}) {
    CommandPreprocessor command(limits, sample_time);
    const double target = step * up * sample_time * up;
    EXPECT_NEAR(sample_time * samples_to_reach(command, target), min_move_time(limits, target),
                1e-9)
        << up;
  }
  const CommandLimits whole{62 * step, limits.acceleration};
  for (const int level : {0, 1, 200}) {
    CommandPreprocessor command(whole, sample_time);
    const double target = whole.rate * sample_time * (62 + level);
    EXPECT_NEAR(sample_time * samples_to_reach(command, target), min_move_time(whole, target), 1e-9)
        << level;
  }
}

TEST(CommandPreprocessor, ClosedFormOfTheLeastTime) {
  EXPECT_DOUBLE_EQ(min_move_time(limits, 0.2), 2.0);
  EXPECT_DOUBLE_EQ(min_move_time(limits, -0.2), 2.0);
  EXPECT_DOUBLE_EQ(min_move_time(limits, 0.3125), 2.5);
  EXPECT_DOUBLE_EQ(min_move_time(limits, 1.0), 4.0 + 1.25);
  EXPECT_DOUBLE_EQ(min_move_time(limits, 0.0), 0.0);
}

TEST(CommandPreprocessor, FollowsAMovingTargetWithoutErrorOnceItIsReached) {
  for (const double rate : {0.0, 0.004, -0.1}) {
    CommandPreprocessor command(limits, sample_time);
    double last_error = 1.0;
    for (int k = 1; k <= 1000; ++k) {
      const double target = 0.5 + rate * sample_time * k;
      command.advance(target, rate);
      last_error = command.now().angle - target;
    }
    EXPECT_EQ(last_error, 0.0) << rate;
    EXPECT_EQ(command.now().rate, rate);
  }
  // An accelerating one too, as long as the acceleration is constant from sample to sample.
  CommandPreprocessor command(limits, sample_time, {0.0, 0.0, 0.0});
  double angle = 0.0, rate = 0.0;
  for (int k = 0; k < 130; ++k) {
    const double acceleration = k < 50 ? 0.1 : -0.15;
    angle += sample_time * (rate + 0.5 * sample_time * acceleration);
    rate += sample_time * acceleration;
    command.advance(angle, rate);
    EXPECT_NEAR(command.now().angle, angle, 1e-14);
  }
}

TEST(CommandPreprocessor, BrakesPassesAndReturnsWhereItCannotStopInTime) {
  CommandPreprocessor command(limits, sample_time);
  for (int k = 0; k < 200; ++k) command.advance(10.0);
  const double at = command.now().angle;
  ASSERT_DOUBLE_EQ(command.now().rate, limits.rate);
  double furthest = at;
  for (int k = 0; k < 500; ++k) {
    furthest = std::max(furthest, command.advance(at).angle);
    ASSERT_LE(std::abs(command.now().acceleration), limits.acceleration * (1.0 + 1e-9));
  }
  const double stop = limits.rate * limits.rate / (2.0 * limits.acceleration);
  EXPECT_NEAR(furthest, at + stop, limits.acceleration * sample_time * sample_time);
  EXPECT_EQ(command.now().angle, at);
  EXPECT_EQ(command.now().rate, 0.0);
}

TEST(CommandPreprocessor, ATargetBeyondTheRateLimitIsChasedAtTheLimit) {
  CommandPreprocessor command(limits, sample_time);
  for (int k = 1; k <= 500; ++k) command.advance(0.4 * sample_time * k, 0.4);
  EXPECT_DOUBLE_EQ(command.now().rate, limits.rate);
}

TEST(CommandPreprocessor, RefusesWhatIsNoLimitAndNoTarget) {
  const auto message = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "accepted";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message([] {
                CommandPreprocessor({0.0, 0.2}, 0.02);
              }),
              HasSubstr("positive finite rate limit, found 0"));
  EXPECT_THAT(message([] {
                CommandPreprocessor({0.25, -1.0}, 0.02);
              }),
              HasSubstr("positive finite acceleration limit, found -1"));
  EXPECT_THAT(message([] {
                CommandPreprocessor({0.25, 0.2}, 0.0);
              }),
              HasSubstr("positive finite sample time, found 0"));
  EXPECT_THAT(message([] {
                CommandPreprocessor({0.25, 0.2}, 0.02, {0.0, 0.3, 0.0});
              }),
              HasSubstr("no faster than 0.25 rad/s, found 0 rad and 0.3 rad/s"));
  EXPECT_THAT(message([&] {
                CommandPreprocessor({0.25, 0.2}, 0.02).advance(nan);
              }),
              HasSubstr("expected a finite target, found nan rad and 0 rad/s"));
  EXPECT_THAT(message([&] {
                min_move_time({nan, 0.2}, 1.0);
              }),
              HasSubstr("positive finite rate limit, found nan"));
}

}  // namespace
}  // namespace boresight::control
