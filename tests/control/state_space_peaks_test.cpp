#include <cmath>

#include <gtest/gtest.h>

#include "reference_loop.hpp"
#include <boresight/control/golden_section.hpp>
#include <boresight/control/state_space_peaks.hpp>

namespace boresight::control {
namespace {

using reference::relative_error;
using reference::two_pi;

constexpr LoopStructure structures[] = {LoopStructure::pi, LoopStructure::pi_with_lag};

// The highest |S| by the dynamic stiffness on a dense grid, its best point polished.
double brute_force(const plant::AntennaPlant& plant, const ControlLaw& law, LoopBreak loop_break) {
  const auto sensitivity = [&](double log_w) {
    const auto response =
        plant::plant_response(plant, Eigen::ArrayXd::Constant(1, std::exp(log_w)));
    return 1.0 / std::abs(1.0 + loop_gain(response, 0, law, reference::delay, loop_break));
  };
  const double low = std::log(two_pi * 1e-3), high = std::log(two_pi * 25.0);
  constexpr int points = 20000;
  const double step = (high - low) / points;
  double best = 0.0, at = low;
  for (int i = 0; i <= points; ++i) {
    const double value = sensitivity(low + i * step);
    if (value > best) {
      best = value;
      at = low + i * step;
    }
  }
  return sensitivity(golden_section_maximum(sensitivity, at - step, at + step, 1e-9));
}

TEST(StateSpacePeaks, AreThoseOfADenseGrid) {
  reference::RandomNumbers random(141);
  for (const auto structure : structures) {
    for (int trial = 0; trial < 4; ++trial) {
      const auto plant = reference::antenna(24.0 - 8.0 * trial);
      auto evaluator = reference::loop_evaluator(plant, 100);
      const ControlLaw law = reference::sound_law(random, evaluator, structure, 6.0);
      const auto peaks = state_space_peaks(plant, law, reference::delay, 1e-4, 25.0);
      for (std::size_t b = 0; b < 3; ++b) {
        EXPECT_LT(relative_error(peaks[b].magnitude, brute_force(plant, law, loop_breaks[b])), 1e-6)
            << to_string(loop_breaks[b]);
      }
    }
  }
}

TEST(StateSpacePeaks, AreThoseOfTheEvaluator) {
  // The evaluator reads its peaks off parabolas through its grid: exact to the tuner's reserve of
  // 2e-5 where every peak is near the usual limit of 2, less so the sharper they are.
  reference::RandomNumbers random(142);
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant);
  for (const auto structure : structures) {
    for (const auto& [highest, tolerance] : {std::pair{2.1, 2e-5}, std::pair{4.0, 5e-4}}) {
      for (int trial = 0; trial < 15; ++trial) {
        const ControlLaw law = reference::sound_law(random, evaluator, structure, highest);
        const auto evaluation = evaluator.evaluate(law, false);
        const auto peaks = state_space_peaks(plant, law, reference::delay, 1e-4, 25.0);
        for (std::size_t b = 0; b < 3; ++b) {
          EXPECT_LT(relative_error(evaluation.highest_peak(loop_breaks[b]), peaks[b].magnitude),
                    tolerance)
              << to_string(loop_breaks[b]) << " " << peaks[b].frequency << " rad/s "
              << testing::PrintToString(law.gains);
        }
      }
    }
  }
}

TEST(StateSpacePeaks, WithADenseGridOfTheEvaluatorAgreeToRounding) {
  reference::RandomNumbers random(143);
  const auto plant = reference::antenna();
  auto dense = reference::loop_evaluator(plant, 6000);
  for (const auto structure : structures) {
    const ControlLaw law = reference::sound_law(random, dense, structure, 3.0);
    const auto evaluation = dense.evaluate(law, false);
    const auto peaks = state_space_peaks(plant, law, reference::delay, 1e-4, 25.0);
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_LT(relative_error(evaluation.highest_peak(loop_breaks[b]), peaks[b].magnitude), 1e-8);
    }
  }
}

}  // namespace
}  // namespace boresight::control
