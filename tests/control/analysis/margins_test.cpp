#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degrees = 180.0 / std::numbers::pi;

Eigen::ArrayXd grid(double low = 1e-3, double high = 1e3, Eigen::Index points = 3000) {
  return Eigen::ArrayXd::LinSpaced(points, std::log(low), std::log(high)).exp();
}

TEST(Margins, OfThreePolesAreTheTextbooks) {
  // k/(s (s+1)(s+2)): on the negative axis at sqrt 2, gain k/6.
  const double k = 1.5;
  const auto loop = [&](double w) {
    const Complex s{0.0, w};
    return k / (s * (s + 1.0) * (s + 2.0));
  };
  const Margins found = margins(loop, grid());
  ASSERT_EQ(found.phase_crossovers.size(), 1u);
  EXPECT_NEAR(found.phase_crossovers[0].frequency, std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(found.increasing_gain_margin, 6.0 / k, 1e-9);
  EXPECT_EQ(found.decreasing_gain_margin, 0.0);
  // At the gain crossover the phase follows from the poles.
  ASSERT_EQ(found.gain_crossovers.size(), 1u);
  const double w = found.gain_crossovers[0].frequency;
  EXPECT_NEAR(std::abs(loop(w)), 1.0, 1e-11);
  const double margin = 90.0 - degrees * (std::atan(w) + std::atan(w / 2.0));
  EXPECT_NEAR(found.phase_margin_deg, margin, 1e-9);
  EXPECT_NEAR(found.delay_margin, margin / degrees / w, 1e-11);
}

TEST(Margins, OfAnIntegratorWithDeadTime) {
  // k e^(-s tau)/s: crossover at k, gain margin pi/(2 k tau), phase margin 90 deg - k tau, delay
  // margin pi/(2k) - tau.
  const double k = 2.0, tau = 0.3;
  const auto loop = [&](double w) { return k * std::polar(1.0, -w * tau) / Complex{0.0, w}; };
  const Margins found = margins(loop, grid());
  EXPECT_NEAR(found.gain_crossovers.at(0).frequency, k, 1e-11);
  EXPECT_NEAR(found.increasing_gain_margin, std::numbers::pi / (2.0 * k * tau), 1e-9);
  EXPECT_NEAR(found.phase_margin_deg, 90.0 - k * tau * degrees, 1e-9);
  EXPECT_NEAR(found.delay_margin, std::numbers::pi / (2.0 * k) - tau, 1e-11);
  // Every later half turn crosses the axis again, at (pi/2 + 2 pi n)/tau.
  ASSERT_GT(found.phase_crossovers.size(), 10u);
  for (std::size_t n = 0; n < 10; ++n) {
    EXPECT_NEAR(found.phase_crossovers[n].frequency,
                (0.5 + 2.0 * static_cast<double>(n)) * std::numbers::pi / tau, 1e-8);
  }
}

TEST(Margins, OfAConditionallyStableLoopGoBothWays) {
  // k (s+2)^2/s^3 is stable for k > 1 alone: s^3 + k s^2 + 4 k s + 4 k, Routh 4 k^2 > 4 k. At k = 3
  // the gain may fall to a third; it may rise without limit.
  const double k = 3.0;
  const auto loop = [&](double w) {
    const Complex s{0.0, w};
    return k * (s + 2.0) * (s + 2.0) / (s * s * s);
  };
  const Margins found = margins(loop, grid());
  EXPECT_EQ(found.increasing_gain_margin, infinity);
  EXPECT_NEAR(found.decreasing_gain_margin, 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(found.phase_crossovers.at(0).frequency, 2.0, 1e-9);
}

TEST(Margins, TurnADelayTheLongWayRoundFromBehindTheAxis) {
  // Gain w^-1/2 at a constant phase: one crossover, at 1 rad/s.
  const double slope = 0.5;
  const auto with_phase = [&](double phase) {
    return [=](double w) { return std::pow(w, -slope) * std::polar(1.0, phase / degrees); };
  };
  // Phase -210: margin -30, the delay must turn it by 330.
  const Margins behind = margins(with_phase(-210.0), grid());
  EXPECT_NEAR(behind.gain_crossovers.at(0).phase_margin_deg, -30.0, 1e-9);
  EXPECT_NEAR(behind.phase_margin_deg, 30.0, 1e-9);
  EXPECT_NEAR(behind.delay_margin, 330.0 / degrees, 1e-9);
  const Margins ahead = margins(with_phase(-150.0), grid());
  EXPECT_NEAR(ahead.gain_crossovers.at(0).phase_margin_deg, 30.0, 1e-9);
  EXPECT_NEAR(ahead.delay_margin, 30.0 / degrees, 1e-9);
}

TEST(Margins, WithoutCrossoversAreUnlimited) {
  const auto loop = [](double w) { return 0.5 / (1.0 + Complex{0.0, w}); };
  const Margins found = margins(loop, grid());
  EXPECT_TRUE(found.gain_crossovers.empty());
  EXPECT_EQ(found.increasing_gain_margin, infinity);
  EXPECT_EQ(found.decreasing_gain_margin, 0.0);
  EXPECT_EQ(found.phase_margin_deg, 180.0);
  EXPECT_EQ(found.delay_margin, infinity);
}

TEST(Margins, DoNotTakeAPassOfThePositiveAxisForACrossover) {
  const auto loop = [](double w) {
    const Complex s{0.0, w};
    return 0.2 * (s * s + 0.1 * s + 1.0) / (s * s + 0.5 * s + 1.5);
  };
  const Margins found = margins(loop, grid());
  EXPECT_TRUE(found.phase_crossovers.empty());
}

template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Margins, ListACrossingOnAGridPointOnce) {
  // (s + 0.1)/(s (s + 1)) has gain 1 at sqrt(0.1).
  const auto loop = [](double w) {
    const Complex s{0.0, w};
    return (s + 0.1) / (s * (s + 1.0));
  };
  const double crossover = std::sqrt(0.1);
  for (const double shift : {0.0, 1e-16, -1e-16, 1e-13, -1e-13}) {
    Eigen::ArrayXd w = grid(crossover * 1e-2, crossover * 1e2, 201);
    w[100] = crossover * (1.0 + shift);
    const Margins found = margins(loop, w);
    ASSERT_EQ(found.gain_crossovers.size(), 1u) << shift;
    EXPECT_NEAR(found.gain_crossovers[0].frequency, crossover, 1e-15);
    EXPECT_TRUE(found.phase_crossovers.empty());
    EXPECT_TRUE(found.tangencies.empty());
  }
}

TEST(Margins, HaveThePeaksOfASecondOrderLoop) {
  // w0^2/(s (s + 2 z w0)): T = w0^2/(s^2 + 2 z w0 s + w0^2), |T| highest at w0 sqrt(1 - 2 z^2).
  const double z = 0.2, w0 = 3.0;
  const auto loop = plant::rational({w0 * w0}, {0.0, 2.0 * z * w0, 1.0}, "u", "y", "x");
  const Margins found = margins(loop);
  EXPECT_NEAR(found.complementary.magnitude, 1.0 / (2.0 * z * std::sqrt(1.0 - z * z)), 1e-12);
  EXPECT_NEAR(found.complementary.frequency, w0 * std::sqrt(1.0 - 2.0 * z * z), 1e-9);
  // |S|^2 = x (x + 4 z^2)/((1 - x)^2 + 4 z^2 x), x = (w/w0)^2.
  const double q = 2.0 * z * z, x = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * q));
  const double sensitivity = std::sqrt(x * (x + 2.0 * q) / ((1.0 - x) * (1.0 - x) + 2.0 * q * x));
  EXPECT_NEAR(found.sensitivity.frequency, w0 * std::sqrt(x), 1e-9);
  EXPECT_NEAR(found.sensitivity.magnitude, sensitivity, 1e-12);
  EXPECT_NEAR(found.distance_to_minus_one(), 1.0 / sensitivity, 1e-12);
  EXPECT_EQ(found.closed_loop_stable, true);
  // The same loop by its function, on a grid that is no finer than it must be.
  const Margins by_function = margins(
      [&](double w) {
        const Complex s{0.0, w};
        return w0 * w0 / (s * (s + 2.0 * z * w0));
      },
      grid(1e-2, 1e3, 60));
  EXPECT_NEAR(by_function.complementary.frequency, found.complementary.frequency, 1e-9);
  EXPECT_NEAR(by_function.disk.alpha, found.disk.alpha, 1e-12);
  EXPECT_NEAR(by_function.disk.frequency, found.disk.frequency, 1e-8);
  EXPECT_FALSE(by_function.closed_loop_stable.has_value());
}

TEST(Margins, AtTheEndsOfTheFrequenciesCount) {
  // -0.5 (s + 1)/(s + 2): L(0) = -1/4, L(infinity) = -1/2. With k L, s (1 - k/2) + 2 - k/2 is
  // stable for k < 2 alone (and above 4): poles pass infinity at 2 and the origin at 4.
  const Margins found = margins(plant::rational({-0.5, -0.5}, {2.0, 1.0}, "u", "y", "x"));
  ASSERT_EQ(found.phase_crossovers.size(), 2u);
  EXPECT_EQ(found.phase_crossovers[0].frequency, 0.0);
  EXPECT_NEAR(found.phase_crossovers[0].gain_margin, 4.0, 1e-14);
  EXPECT_EQ(found.phase_crossovers[1].frequency, infinity);
  EXPECT_NEAR(found.increasing_gain_margin, 2.0, 1e-14);
  EXPECT_EQ(found.lowest_frequency, 0.0);
  EXPECT_EQ(found.highest_frequency, infinity);
  EXPECT_NEAR(found.sensitivity.magnitude, 2.0, 1e-14);
  EXPECT_EQ(found.sensitivity.frequency, infinity);
  // A sampled integrator k/(z - 1) is stable for k < 2: the pole leaves at z = -1.
  plant::StateSpace sampled = plant::rational({0.8}, {-1.0, 1.0}, "u", "y", "x");
  sampled.sample_time = 0.1;
  const Margins discrete = margins(sampled);
  ASSERT_EQ(discrete.phase_crossovers.size(), 1u);
  EXPECT_EQ(discrete.phase_crossovers[0].frequency, 10.0 * std::numbers::pi);
  EXPECT_NEAR(discrete.increasing_gain_margin, 2.0 / 0.8, 1e-14);
  EXPECT_EQ(discrete.highest_frequency, 10.0 * std::numbers::pi);
  // |z - 1| = k: 2 sin(w T/2) = k, and the angle of -1/(z - 1) is wT/2 - 90 deg.
  const double w = 2.0 / 0.1 * std::asin(0.4);
  EXPECT_NEAR(discrete.gain_crossovers.at(0).frequency, w, 1e-12);
  EXPECT_NEAR(discrete.phase_margin_deg, 90.0 - 0.05 * w * degrees, 1e-10);
}

TEST(Margins, InventNoCrossingWhereALoopApproachesTheAxis) {
  // Double integrators come from the axis, many poles more than zeros go to it.
  for (const auto& loop : {plant::rational({1.0, 10.0}, {0.0, 0.0, 10.0, 1.0}, "u", "y", "x"),
                           plant::rational({1e15}, {1e11, 1.01e7, 10.0}, "u", "y", "x"),
                           plant::rational({1.0, 3.0}, {0.0, 0.0, 1.0}, "u", "y", "x")}) {
    for (const auto& found : {margins(loop).phase_crossovers, crossovers(loop).phase}) {
      EXPECT_TRUE(found.empty());
    }
  }
  // Nor where the gain is 1 at rest.
  const auto unit = plant::rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  EXPECT_TRUE(margins(unit).gain_crossovers.empty());
  EXPECT_TRUE(crossovers(unit).gain.empty());
  // Nor at an undamped pole, where the angle jumps.
  const auto oscillator = plant::rational({1.0}, {1.0, 1.0, 1.0, 1.0}, "u", "y", "x");
  for (const auto& found : {margins(oscillator).phase_crossovers, crossovers(oscillator).phase}) {
    EXPECT_TRUE(found.empty());
  }
}

TEST(Margins, OfALoopOfGainOneAtAllFrequenciesHaveNoGainCrossovers) {
  // An all-pass: |L| = 1 everywhere, L(0) = -1.
  const auto loop = plant::rational({-1.0, 1.0}, {1.0, 1.0}, "u", "y", "x");
  for (const auto& found : {margins(loop).gain_crossovers, crossovers(loop).gain}) {
    EXPECT_TRUE(found.empty());
  }
  EXPECT_EQ(margins(loop).decreasing_gain_margin, 1.0);
  EXPECT_EQ(margins(loop).sensitivity.magnitude, infinity);
  EXPECT_EQ(margins(loop).disk.alpha, 0.0);
}

// A resonance on a lag: near its frequency |L| has a maximum that `gain` takes to any height.
plant::StateSpace resonance(double gain, double damping = 0.02) {
  const auto peak = [&](double w) {
    const Complex s{0.0, w};
    return std::abs(1.0 / (s * s + 2.0 * damping * s + 1.0));
  };
  const double highest = peak(std::sqrt(1.0 - 2.0 * damping * damping));
  return plant::rational({gain / highest}, {1.0, 2.0 * damping, 1.0}, "u", "y", "x");
}

TEST(Margins, ClassifyTheGainThatNearlyReachesOne) {
  for (const double excess : {1e-3, 1e-5, 1e-7, 1e-9, -1e-9, -1e-7, -1e-5, -1e-3, 0.0}) {
    const auto loop = resonance(std::exp(excess));
    SCOPED_TRACE(excess);
    for (const auto& [gain, tangencies] :
         {std::pair{margins(loop).gain_crossovers, margins(loop).tangencies},
          std::pair{crossovers(loop).gain, crossovers(loop).tangencies}}) {
      ASSERT_EQ(tangencies.size(), 1u);
      EXPECT_EQ(tangencies[0].kind, CrossoverKind::gain);
      EXPECT_NEAR(tangencies[0].distance, std::abs(excess), 1e-13);
      EXPECT_NEAR(tangencies[0].frequency, std::sqrt(1.0 - 2.0 * 0.02 * 0.02), 1e-9);
      if (excess > 0.0) {
        EXPECT_EQ(tangencies[0].approach, Approach::crosses);
        ASSERT_EQ(gain.size(), 2u);
        // |s^2 + 2 d s + 1|^2 = gain^-2, of the top value: quadratic in w^2.
        const double top = 4.0 * 0.02 * 0.02 * (1.0 - 0.02 * 0.02);
        const double half = std::sqrt(top * std::expm1(2.0 * excess));
        const double low = std::sqrt(1.0 - 2.0 * 0.02 * 0.02 - half);
        const double high = std::sqrt(1.0 - 2.0 * 0.02 * 0.02 + half);
        // A millionth of a wide maximum is known to 1e-16 over its height.
        const double tolerance = 1e-12 + 1e-16 / std::sqrt(excess);
        EXPECT_NEAR(gain[0].frequency, low, tolerance);
        EXPECT_NEAR(gain[1].frequency, high, tolerance);
      } else if (excess < 0.0) {
        EXPECT_EQ(tangencies[0].approach, Approach::misses);
        EXPECT_TRUE(gain.empty());
      } else {
        EXPECT_EQ(tangencies[0].approach, Approach::touches);
        EXPECT_EQ(gain.size(), 1u);
      }
    }
  }
}

TEST(Margins, FindAPairOfCrossoversBetweenTwoGridPoints) {
  const auto loop = [](double w) {
    const double d = 0.01;
    const Complex s{0.0, w};
    return 1.1 * 2.0 * d / (s * s + 2.0 * d * s + 1.0);
  };
  // No point of the grid is above 1.
  Eigen::ArrayXd w = grid(0.1, 10.0, 26);
  EXPECT_LT(w.unaryExpr([&](double x) { return std::abs(loop(x)); }).maxCoeff(), 1.0);
  const Margins found = margins(loop, w);
  ASSERT_EQ(found.gain_crossovers.size(), 2u);
  EXPECT_LT(found.gain_crossovers[0].frequency, 1.0);
  EXPECT_GT(found.gain_crossovers[1].frequency, 1.0);
}

TEST(Margins, ClassifyTheAngleThatNearlyReachesTheAxis) {
  const auto loop_with = [](double offset) {
    return [=](double w) {
      // Nearest to the axis at 1 rad/s, while the gain falls.
      const double x = std::log(w);
      const double angle = 0.2 * x * x + offset;
      return -std::polar(std::pow(w, -0.5), angle);
    };
  };
  for (const double offset : {1e-3, 1e-6, 1e-9, -1e-9, -1e-6, -1e-3}) {
    const Margins found = margins(loop_with(offset), grid(0.1, 10.0, 41));
    ASSERT_EQ(found.tangencies.size(), 1u) << offset;
    EXPECT_EQ(found.tangencies[0].kind, CrossoverKind::phase);
    EXPECT_NEAR(found.tangencies[0].distance, std::sin(std::abs(offset)), 1e-14);
    EXPECT_EQ(found.phase_crossovers.size(), offset < 0.0 ? 2u : 0u);
    EXPECT_EQ(found.tangencies[0].approach, offset < 0.0 ? Approach::crosses : Approach::misses);
  }
  const Margins touching = margins(loop_with(0.0), grid(0.1, 10.0, 41));
  EXPECT_EQ(touching.tangencies.at(0).approach, Approach::touches);
  EXPECT_EQ(touching.phase_crossovers.size(), 1u);
}

TEST(Margins, WithDeadTimeAreThoseOfTheExactDelay) {
  // k e^(-s tau)/s, as above; and of the same loop by its function.
  const double k = 2.0, tau = 0.3;
  const auto integrator = plant::rational({k}, {0.0, 1.0}, "u", "y", "x");
  const Margins found = margins(integrator, {.dead_time = tau});
  EXPECT_NEAR(found.gain_crossovers.at(0).frequency, k, 1e-13);
  EXPECT_NEAR(found.increasing_gain_margin, std::numbers::pi / (2.0 * k * tau), 1e-12);
  EXPECT_NEAR(found.delay_margin, std::numbers::pi / (2.0 * k) - tau, 1e-13);
  // Crossings at (pi/2 + 2 pi n)/tau, all of them up to where |L| = k/w is below 1e-3.
  const auto& crossings = found.phase_crossovers;
  EXPECT_GE(found.highest_frequency, 2000.0);
  ASSERT_GE(crossings.size(), static_cast<std::size_t>(2000.0 * tau / (2.0 * std::numbers::pi)));
  for (std::size_t n = 0; n < crossings.size(); ++n) {
    const double w = (0.5 + 2.0 * static_cast<double>(n)) * std::numbers::pi / tau;
    EXPECT_NEAR(crossings[n].frequency, w, 1e-12 * w);
    EXPECT_NEAR(crossings[n].gain_margin, w / k, 1e-11 * w);
  }
  EXPECT_FALSE(found.closed_loop_stable.has_value());
  // A feedthrough never fades: |L| tends to 1/2, and the distance to -1 to 1/2.
  const auto proper = plant::rational({0.2, 0.5}, {1.0, 1.0}, "u", "y", "x");
  const Margins turning = margins(proper, {.dead_time = 1.0});
  EXPECT_NEAR(turning.increasing_gain_margin, 2.0, 1e-12);
  EXPECT_EQ(turning.phase_crossovers.back().frequency, infinity);
  EXPECT_NEAR(turning.sensitivity.magnitude, 2.0, 1e-12);
  // Sampled: a whole number of samples is z^-k.
  plant::StateSpace sampled = plant::rational({0.3}, {-1.0, 1.0}, "u", "y", "x");
  sampled.sample_time = 0.1;
  plant::StateSpace delayed = plant::rational({0.3}, {0.0, -1.0, 1.0}, "u", "y", "x");
  delayed.sample_time = 0.1;
  const Margins with_delay = margins(sampled, {.dead_time = 0.1}), with_state = margins(delayed);
  EXPECT_NEAR(with_delay.phase_margin_deg, with_state.phase_margin_deg, 1e-10);
  ASSERT_EQ(with_delay.phase_crossovers.size(), with_state.phase_crossovers.size());
  EXPECT_NEAR(with_delay.increasing_gain_margin, with_state.increasing_gain_margin, 1e-12);
}

TEST(Margins, RefuseWhatTheyCannotAnswer) {
  const auto loop = plant::rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  const auto function = [](double w) { return 1.0 / Complex{1.0, w}; };
  EXPECT_THAT(message_of([&] { margins(function, Eigen::ArrayXd(0)); }),
              testing::HasSubstr("grid of frequencies is empty"));
  EXPECT_THAT(message_of([&] { margins(function, Eigen::Array2d(2.0, 1.0)); }),
              testing::HasSubstr("positive frequencies that rise, found 1 rad/s at position 1"));
  const auto broken = [](double) { return Complex{std::nan(""), 0.0}; };
  EXPECT_THAT(message_of([&] { margins(broken, grid()); }),
              testing::HasSubstr("the loop gain is not a number at 0.001"));
  EXPECT_THAT(message_of([&] { margins(loop, {.dead_time = -1.0}); }),
              testing::HasSubstr("margins: expected a dead time of 0 or more, found -1 s"));
  EXPECT_THAT(message_of([&] {
                margins(plant::rational({1.0, 2.0}, {1.0, 1.0}, "u", "y", "x"), {.dead_time = 1.0});
              }),
              testing::HasSubstr("feedthrough below 1 in a loop with dead time, found 2"));
  EXPECT_THAT(message_of([&] { margins(loop, {.dead_time = 1e9}); }),
              testing::HasSubstr("more than four million points"));
  const auto two = plant::static_gain(Eigen::Matrix2d::Identity(), {"a", "b"}, {"c", "d"});
  EXPECT_THAT(message_of([&] { margins(two); }),
              testing::HasSubstr("margins: expected a loop of one input and one output, found 2"));
  EXPECT_THAT(message_of([&] { crossovers(two); }),
              testing::HasSubstr("crossovers: expected a loop of one input and one output"));
}

TEST(Margins, OfAStaticGainAreItsOwn) {
  const auto gain = plant::static_gain(Eigen::MatrixXd::Constant(1, 1, -0.25), {"u"}, {"y"});
  const Margins found = margins(gain);
  EXPECT_TRUE(found.gain_crossovers.empty());
  EXPECT_EQ(found.increasing_gain_margin, 4.0);
  EXPECT_NEAR(found.sensitivity.magnitude, 4.0 / 3.0, 1e-15);
  EXPECT_EQ(crossovers(gain).phase.size(), 2u);
}

// The reference antenna's loop at a break, as a function of frequency.
auto antenna_loop(const plant::AntennaPlant& plant, const Controller& controller,
                  LoopBreak loop_break) {
  return [=](double w) {
    return loop_gain(plant::PointResponse(plant)(w), w, controller, reference::delay, loop_break);
  };
}

TEST(Margins, OfTheAntennaPutAPoleOnTheAxisWhenUsedUp) {
  const auto plant = reference::antenna();
  const Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-4, 25.0, 200);
  auto evaluator = reference::loop_evaluator(plant, 200);
  reference::RandomNumbers random(111);
  for (const auto& structure : {LoopStructure::pi(), LoopStructure::pi_with_lag()}) {
    for (int trial = 0; trial < 3; ++trial) {
      const Controller controller = reference::sound_controller(random, evaluator, structure, 2.5);
      ASSERT_LT(numerics::spectral_abscissa(closed_loop(plant, controller, reference::delay).a),
                0.0);
      // The rate gain multiplies the loop at the valve, the position gain the one at the command.
      const std::size_t position_gain = controller.gains.size() - 2;
      for (const auto& [loop_break, index] : {std::pair{LoopBreak::valve_command, std::size_t{0}},
                                              std::pair{LoopBreak::position_loop, position_gain}}) {
        const Margins found = margins(antenna_loop(plant, controller, loop_break), w);
        for (const double factor : {found.increasing_gain_margin, found.decreasing_gain_margin}) {
          if (factor == infinity || factor == 0.0) continue;
          Controller changed = controller;
          changed.gains[index] *= factor;
          EXPECT_NEAR(numerics::spectral_abscissa(closed_loop(plant, changed, reference::delay).a),
                      0.0, 1e-6)
              << to_string(loop_break) << " gain times " << factor;
        }
        if (loop_break != LoopBreak::valve_command || found.delay_margin > 0.5) continue;
        EXPECT_NEAR(numerics::spectral_abscissa(
                        closed_loop(plant, controller, reference::delay + found.delay_margin).a),
                    0.0, 1e-5)
            << "delay margin " << found.delay_margin;
      }
    }
  }
}

}  // namespace
}  // namespace boresight::control
