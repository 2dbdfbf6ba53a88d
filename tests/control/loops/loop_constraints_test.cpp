#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/loops/loop_constraints.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using reference::relative_error;
constexpr double delay = 0.03;

LoopChannels reference_channels() {
  const auto plant = reference::antenna();
  return make_channels(plant, plant::frequency_grid(plant, 1e-4, 100.0, 100));
}

std::vector<Controller> controllers() {
  return {
      {LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}},
      {LoopStructure::pressure_feedback(), {0.5, 1.0, 30.0, 0.004, 1.5, 0.4, 0.05}},
      {LoopStructure::named("FULL+C"), {0.3, 0.9, 20.0, 60.0, 0.003, 1.0, 0.3, 0.04, 0.002, 2.0}},
      {LoopStructure::named("PI+N"), {0.2, 0.8, 10.0, 0.2, 0.02, 14.0, 0.3, 0.8}}};
}

std::complex<double> gain_at(const LoopChannels& channels, const Controller& controller,
                             LoopBreak cut, double w) {
  return loop_gain(channels.at(w), w, controller, delay, cut);
}

TEST(LoopConstraints, GiveTheLoopGainAndItsDerivatives) {
  const auto channels = reference_channels();
  for (const Controller& controller : controllers()) {
    for (const LoopBreak cut : loop_breaks) {
      for (const double w : {0.05, 1.3, 5.0, 14.1, 60.0}) {
        const auto point = loop_gain_with_gradient(channels.at(w), w, controller, delay, cut);
        EXPECT_LT(relative_error(point.value, gain_at(channels, controller, cut, w)), 1e-12);
        for (std::size_t k = 0; k < controller.gains.size(); ++k) {
          constexpr double step = 1e-5;
          Controller up = controller, down = controller;
          up.gains[k] *= 1.0 + step;
          down.gains[k] *= 1.0 - step;
          const auto change =
              std::log(gain_at(channels, up, cut, w) / gain_at(channels, down, cut, w)) /
              (2.0 * step);
          EXPECT_LT(std::abs(point.by_gain[k] - change), 1e-8);
        }
      }
    }
  }
}

TEST(LoopConstraints, AreTheMarginsThatMarginsFinds) {
  const auto channels = reference_channels();
  for (const Controller& controller : controllers()) {
    for (const LoopBreak cut : loop_breaks) {
      const Margins known = margins([&](double w) { return gain_at(channels, controller, cut, w); },
                                    channels.response.frequency);
      const auto gain = smallest_gain_margins(channels, delay, controller, cut);
      const double smallest =
          std::min(known.increasing_gain_margin, 1.0 / known.decreasing_gain_margin);
      ASSERT_FALSE(gain.empty());
      EXPECT_LT(relative_error(gain.front().value, smallest), 1e-9);
      const auto phase = smallest_phase_margins(channels, delay, controller, cut);
      EXPECT_EQ(phase.empty(), known.gain_crossovers.empty());
      if (!phase.empty()) {
        EXPECT_LT(
            relative_error(phase.front().value * 180.0 / std::numbers::pi, known.phase_margin_deg),
            1e-9);
      }
      EXPECT_LE(gain.size(), 3u);
      EXPECT_TRUE(std::ranges::is_sorted(gain, {}, &LoopQuantity::value));
    }
  }
}

TEST(LoopConstraints, HaveTheGradientsOfTheirCentralDifferences) {
  const auto channels = reference_channels();
  const auto check = [](const Controller& controller, const auto& quantity, const char* what) {
    const std::optional<LoopQuantity> here = quantity(controller);
    if (!here) return;
    for (std::size_t k = 0; k < controller.gains.size(); ++k) {
      constexpr double step = 1e-5;
      Controller up = controller, down = controller;
      up.gains[k] *= std::exp(step);
      down.gains[k] *= std::exp(-step);
      const double change = std::log(quantity(up)->value / quantity(down)->value) / (2.0 * step);
      EXPECT_NEAR(here->log_gradient[k], change, 1e-6 * std::max(1.0, std::abs(change)))
          << what << " " << controller.structure.gains()[k].name;
    }
  };
  const auto first = [](const std::vector<LoopQuantity>& list) {
    return list.empty() ? std::nullopt : std::optional(list.front());
  };
  for (const Controller& controller : controllers()) {
    for (const LoopBreak cut : loop_breaks) {
      check(
          controller,
          [&](const Controller& one) {
            return first(smallest_gain_margins(channels, delay, one, cut));
          },
          "gain margin");
      check(
          controller,
          [&](const Controller& one) {
            return first(smallest_phase_margins(channels, delay, one, cut));
          },
          "phase margin");
    }
    check(
        controller, [&](const Controller& one) { return position_bandwidth(channels, delay, one); },
        "bandwidth");
  }
}

TEST(LoopConstraints, FindTheBandwidthWhereTheSensitivityIsHalfInPower) {
  const auto channels = reference_channels();
  for (const Controller& controller : controllers()) {
    const auto bandwidth = position_bandwidth(channels, delay, controller);
    ASSERT_TRUE(bandwidth);
    const auto sensitivity = [&](double w) {
      return 1.0 / std::abs(1.0 + gain_at(channels, controller, LoopBreak::position_loop, w));
    };
    EXPECT_NEAR(sensitivity(bandwidth->value), std::numbers::sqrt2 / 2.0, 1e-12);
    for (double fraction = 0.01; fraction < 0.999; fraction += 0.01) {
      EXPECT_LT(sensitivity(fraction * bandwidth->value), std::numbers::sqrt2 / 2.0);
    }
  }
}

TEST(LoopConstraints, FindNothingWhereNothingCrosses) {
  const auto plant = reference::antenna();
  const auto high = make_channels(plant, plant::frequency_grid(plant, 50.0, 100.0, 100));
  const Controller controller = controllers().front();
  EXPECT_TRUE(smallest_phase_margins(high, delay, controller, LoopBreak::valve_command).empty());
  EXPECT_FALSE(position_bandwidth(high, delay, controller));
  EXPECT_THROW(position_bandwidth(high, delay, {LoopStructure::pi(), {1.0}}), InvalidInput);
}

}  // namespace
}  // namespace boresight::control
