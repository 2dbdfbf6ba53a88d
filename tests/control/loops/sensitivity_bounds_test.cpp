#include <cmath>

#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/golden_section.hpp>

namespace boresight::control {
namespace {

using reference::relative_error;

const std::vector<LoopStructure> structures = reference::loop_structures();

// The highest |S| by the dynamic stiffness on a dense grid, its best point polished.
double brute_force(const plant::AntennaPlant& plant, const Controller& controller,
                   LoopBreak loop_break) {
  const plant::PointResponse response(plant);
  const auto sensitivity = [&](double log_w) {
    const double w = std::exp(log_w);
    return 1.0 /
           std::abs(1.0 + loop_gain(response(w), w, controller, reference::delay, loop_break));
  };
  const double low = std::log(two_pi * 1e-5), high = std::log(two_pi * 250.0);
  constexpr int points = 35000;
  const double step = (high - low) / points;
  double best = 0.0, at = low;
  for (int i = 0; i <= points; ++i) {
    const double value = sensitivity(low + i * step);
    if (value > best) {
      best = value;
      at = low + i * step;
    }
  }
  return sensitivity(numerics::golden_section_maximum(sensitivity, at - step, at + step, 1e-9));
}

TEST(SensitivityBounds, AreThoseOfADenseGrid) {
  reference::RandomNumbers random(141);
  for (const auto& structure : structures) {
    for (int trial = 0; trial < 4; ++trial) {
      const auto plant = reference::antenna(24.0 - 8.0 * trial);
      auto evaluator = reference::loop_evaluator(plant, 100);
      const Controller controller = reference::sound_controller(random, evaluator, structure, 6.0);
      const auto bounds = sensitivity_bounds(plant, controller, reference::delay);
      for (std::size_t b = 0; b < 3; ++b) {
        const double highest = brute_force(plant, controller, loop_breaks[b]);
        EXPECT_TRUE(bounds[b].closed);
        EXPECT_LT(relative_error(bounds[b].lower, highest), 1e-8)
            << to_string(loop_breaks[b]) << ", " << structure.name() << ", " << bounds[b].frequency
            << " rad/s";
        EXPECT_LE(highest, bounds[b].upper * (1.0 + 1e-12)) << to_string(loop_breaks[b]);
      }
    }
  }
}

TEST(SensitivityBounds, AreThoseOfTheEvaluator) {
  // The evaluator polishes the maxima it sees on its grid: exact to the tuner's reserve where it
  // sees the right ones.
  reference::RandomNumbers random(142);
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant);
  for (const auto& structure : structures) {
    for (const auto& [highest, tolerance] : {std::pair{2.1, 1e-6}, std::pair{4.0, 1e-6}}) {
      for (int trial = 0; trial < 15; ++trial) {
        const Controller controller =
            reference::sound_controller(random, evaluator, structure, highest);
        const auto evaluation = evaluator.evaluate(controller, false);
        const auto bounds = sensitivity_bounds(plant, controller, reference::delay);
        for (std::size_t b = 0; b < 3; ++b) {
          EXPECT_LT(relative_error(evaluation.highest_peak(loop_breaks[b]), bounds[b].lower),
                    tolerance)
              << to_string(loop_breaks[b]) << " " << bounds[b].frequency << " rad/s "
              << testing::PrintToString(controller.gains);
        }
      }
    }
  }
}

TEST(SensitivityBounds, WithADenseGridOfTheEvaluatorAgreeToRounding) {
  reference::RandomNumbers random(143);
  const auto plant = reference::antenna();
  auto dense = reference::loop_evaluator(plant, 6000);
  for (const auto& structure : structures) {
    const Controller controller = reference::sound_controller(random, dense, structure, 3.0);
    const auto evaluation = dense.evaluate(controller, false);
    const auto bounds = sensitivity_bounds(plant, controller, reference::delay);
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_LT(relative_error(evaluation.highest_peak(loop_breaks[b]), bounds[b].lower), 1e-8);
    }
  }
}

TEST(SensitivityBounds, HoldForHundredsOfModes) {
  // The plant's modes spread over many: the same stiffness and inertia, so nearly the same loop.
  auto plant = reference::antenna();
  const auto lumped = plant.structure.modes;
  plant.structure.modes.clear();
  constexpr int parts = 50;
  for (const auto& mode : lumped) {
    for (int i = 0; i < parts; ++i) {
      auto part = mode;
      for (double* value : {&part.inertia, &part.stiffness, &part.damping, &part.wind_fraction,
                            &part.beam_weight}) {
        *value /= parts;
      }
      plant.structure.modes.push_back(part);
    }
  }
  const Controller controller{LoopStructure::pi_with_lag(), {0.05, 0.5, 3.0, 0.3, 0.01}};
  const auto many = sensitivity_bounds(plant, controller, reference::delay);
  const auto few = sensitivity_bounds(reference::antenna(), controller, reference::delay);
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_TRUE(many[b].closed);
    EXPECT_LT(relative_error(many[b].lower, few[b].lower), 1e-9);
  }
}

}  // namespace
}  // namespace boresight::control
