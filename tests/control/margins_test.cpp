#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "reference_loop.hpp"
#include <boresight/control/closed_loop.hpp>
#include <boresight/control/margins.hpp>
#include <boresight/plant/eigenvalues.hpp>

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

// The reference antenna's loop at a break, as a function of frequency.
auto antenna_loop(const plant::AntennaPlant& plant, const ControlLaw& law, LoopBreak loop_break) {
  return [=](double w) {
    return loop_gain(plant::plant_response(plant, Eigen::ArrayXd::Constant(1, w)), 0, law,
                     reference::delay, loop_break);
  };
}

TEST(Margins, OfTheAntennaPutAPoleOnTheAxisWhenUsedUp) {
  const auto plant = reference::antenna();
  const Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-4, 25.0, 200);
  auto evaluator = reference::loop_evaluator(plant, 200);
  reference::RandomNumbers random(111);
  for (const auto structure : {LoopStructure::pi, LoopStructure::pi_with_lag}) {
    for (int trial = 0; trial < 3; ++trial) {
      const ControlLaw law = reference::sound_law(random, evaluator, structure, 2.5);
      ASSERT_LT(plant::spectral_abscissa(closed_loop(plant, law, reference::delay).a), 0.0);
      // The rate gain multiplies the loop at the valve, the position gain the one at the command.
      const std::size_t position_gain = law.gains.size() - 2;
      for (const auto& [loop_break, index] : {std::pair{LoopBreak::valve_command, std::size_t{0}},
                                              std::pair{LoopBreak::position_loop, position_gain}}) {
        const Margins found = margins(antenna_loop(plant, law, loop_break), w);
        for (const double factor : {found.increasing_gain_margin, found.decreasing_gain_margin}) {
          if (factor == infinity || factor == 0.0) continue;
          ControlLaw changed = law;
          changed.gains[index] *= factor;
          EXPECT_NEAR(plant::spectral_abscissa(closed_loop(plant, changed, reference::delay).a),
                      0.0, 1e-6)
              << to_string(loop_break) << " gain times " << factor;
        }
        if (loop_break != LoopBreak::valve_command || found.delay_margin > 0.5) continue;
        EXPECT_NEAR(plant::spectral_abscissa(
                        closed_loop(plant, law, reference::delay + found.delay_margin).a),
                    0.0, 1e-5)
            << "delay margin " << found.delay_margin;
      }
    }
  }
}

}  // namespace
}  // namespace boresight::control
