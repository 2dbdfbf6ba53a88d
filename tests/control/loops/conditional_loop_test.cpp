#include <cmath>

#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include <boresight/control/analysis/absolute_stability.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/conditional_loop.hpp>
#include <boresight/control/loops/loop_point.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::control {
namespace {

// Leaky loops of the reference antenna with a slow integral: stable with it and while it holds.
Controller slow_integral(double corner) {
  Controller controller{LoopStructure::named("DPF+L+D"), {}};
  for (const auto& gain : controller.structure.gains()) {
    const double value = gain.symbol == "kr"    ? 0.3
                         : gain.symbol == "wp"  ? 60.0
                         : gain.symbol == "kT"  ? 0.02
                         : gain.symbol == "wd"  ? 3.0
                         : gain.symbol == "kp"  ? 1.5
                         : gain.symbol == "wip" ? corner
                         : gain.symbol == "dzp" ? 0.1
                         : gain.symbol == "wpp" ? 1.0
                                                : 4.0;
    controller.gains.push_back(value);
  }
  return controller;
}

// 1 + k L is the return of both loops with k times the integral, over that without it.
TEST(ConditionalLoopGain, IsTheRatioOfReturns) {
  const auto plant = reference::antenna();
  const plant::PointResponse response(plant);
  const Controller whole = slow_integral(0.2);
  const Controller held = without_conditional_integral(whole);
  for (const double w : {0.01, 0.3, 2.0, 9.0, 60.0}) {
    for (const double k : {0.3, 1.0}) {
      const auto part = slow_integral(k * 0.2);
      const auto ratio = loop_point(response(w), part, w, reference::delay).both_return /
                         loop_point(response(w), held, w, reference::delay).both_return;
      const auto found = 1.0 + k * conditional_loop_gain(response(w), w, whole, reference::delay);
      EXPECT_LT(std::abs(found / ratio - 1.0), 1e-12) << w;
    }
  }
}

// What Popov proves, no linear loop between the two contradicts; a corner that makes the linear
// loop unstable is not proven.
TEST(ConditionalLoopGain, IsProvenOnlyWhereEveryLinearLoopIsStable) {
  const auto plant = reference::antenna();
  const plant::PointResponse response(plant);
  const Eigen::ArrayXd grid = plant::frequency_grid(plant, 1e-4, 100.0, 300);
  const auto is_stable = [&](const Controller& controller) {
    return stability(plant, controller, reference::delay, grid).stable();
  };
  ASSERT_TRUE(is_stable(without_conditional_integral(slow_integral(1.0))));
  int proven = 0, unstable = 0;
  for (const double corner : {0.01, 0.05, 0.2, 0.8, 3.0, 12.0}) {
    const Controller controller = slow_integral(corner);
    const bool proof =
        absolute_stability(
            [&](double w) {
              return conditional_loop_gain(response(w), w, controller, reference::delay);
            },
            grid)
            .proven;
    proven += proof ? 1 : 0;
    unstable += is_stable(controller) ? 0 : 1;
    for (const double fraction : {0.01, 0.1, 0.5, 1.0}) {
      EXPECT_TRUE(!proof || is_stable(slow_integral(fraction * corner))) << corner;
    }
  }
  EXPECT_GE(proven, 2);
  EXPECT_GE(unstable, 1);
}

// Next to the limit of the linear loop nothing is proven, though it and the held loop are stable.
TEST(ConditionalLoopGain, IsNotProvenNextToTheLimitOfTheLinearLoop) {
  const auto plant = reference::antenna();
  const plant::PointResponse response(plant);
  const Eigen::ArrayXd grid = plant::frequency_grid(plant, 1e-4, 100.0, 300);
  const auto is_stable = [&](double corner) {
    return stability(plant, slow_integral(corner), reference::delay, grid).stable();
  };
  double low = 0.01, high = 12.0;
  ASSERT_TRUE(is_stable(low) && !is_stable(high));
  while (high > 1.002 * low) {
    const double middle = std::sqrt(low * high);
    (is_stable(middle) ? low : high) = middle;
  }
  const auto proof = absolute_stability(
      [&](double w) {
        return conditional_loop_gain(response(w), w, slow_integral(low), reference::delay);
      },
      grid);
  EXPECT_FALSE(proof.proven);
  EXPECT_LT(std::abs(proof.distance), 0.1);
}

TEST(ConditionalLoopGain, IsOfAConditionalIntegralOnly) {
  const plant::PointResponse response(reference::antenna());
  EXPECT_THROW(conditional_loop_gain(response(1.0), 1.0, {LoopStructure::pi(), {1, 1, 1, 1}}, 0.03),
               InvalidInput);
}

}  // namespace
}  // namespace boresight::control
