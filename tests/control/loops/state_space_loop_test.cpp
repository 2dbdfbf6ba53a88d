#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include "lag_loops.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/linear/interconnection.hpp>

// A state space in the loop, by independent methods: the evaluator's frequency response, the exact
// sampled loop, and the loops that it is the sampled form of.

namespace boresight::control {
namespace {

constexpr double sample_time = 0.02;

Controller loops() {
  return reference::lag_loops();
}

Controller states(double factor = 1.0) {
  plant::StateSpace system = plant::subsystem(sampled_controller(loops(), sample_time),
                                              {"tachometer", "encoder"}, {"valve_demand"});
  system.c *= factor;
  system.d *= factor;
  return state_space_controller("states", system);
}

// With pressure feedback and compliance compensation: it reads the torque.
Controller states_with_torque() {
  const Controller cautious{LoopStructure::named("FULL+L+C"),
                            {0.3, 3.0, 40.0, 2e-3, 1.0, 4.0, 1.5, 15.0, 1e-4, 1.0}};
  return state_space_controller(
      "states with torque",
      plant::subsystem(sampled_controller(cautious, sample_time),
                       {"tachometer", "encoder", "motor_torque"}, {"valve_demand"}));
}

TEST(StateSpaceLoop, HasTheVariancesOfItsLoops) {
  auto evaluator = reference::loop_evaluator(reference::antenna());
  const auto expected = evaluator.evaluate(loops(), false);
  const auto found = evaluator.evaluate(states(), true);
  ASSERT_TRUE(expected.stable());
  EXPECT_TRUE(found.stable());
  EXPECT_NEAR(found.wind_variance / expected.wind_variance, 1.0, 2e-3);
  EXPECT_NEAR(found.noise_variance / expected.noise_variance, 1.0, 0.02);
}

// Without a lag: its response to the tachometer is as high at the Nyquist frequency as the hold
// lets it be.
Controller states_without_lag(double factor) {
  const Controller proportional{LoopStructure::named("PI-0"), {0.5, 0.05, 0.5, 0.01}};
  plant::StateSpace system = plant::subsystem(sampled_controller(proportional, sample_time),
                                              {"tachometer", "encoder"}, {"valve_demand"});
  system.c *= factor;
  system.d *= factor;
  return state_space_controller("states without lag", system);
}

// By the exact sampled loop up to the Nyquist frequency.
TEST(StateSpaceLoop, HasTheEffortOfItsSamples) {
  const auto plant = reference::antenna();
  const auto noise = reference::sensor_noise();
  auto evaluator = reference::loop_evaluator(plant);
  for (const Controller& controller : {states(), states_with_torque(), states_without_lag(1.0)}) {
    const double nyquist = nyquist_frequency(controller);
    EXPECT_NEAR(nyquist, 157.0796, 1e-3);
    ControlledAntenna antenna(plant, *controller.structure.state_space(), 0.0);
    const std::array rms{noise.tachometer_rms, noise.encoder_rms, noise.torque_rms};
    constexpr int points = 20000;
    double expected = 0.0, received = 0.0;
    for (int i = 0; i < points; ++i) {
      const double w = nyquist * (i + 0.5) / points;
      const auto at = antenna.at(w);
      double density = 0.0;
      for (std::size_t k = 0; k < rms.size(); ++k) {
        density += rms.at(k) * rms.at(k) / noise.bandwidth * std::norm(at.demand_by_noise.at(k));
      }
      expected += density * nyquist / two_pi / points;
      received += density / sample_density(controller, w) * nyquist / two_pi / points;
    }
    const double found = evaluator.evaluate(controller, false).effort_variance;
    EXPECT_NEAR(found / expected, 1.0, 1e-3) << controller.structure.name();
    EXPECT_LT(received, 0.998 * expected) << controller.structure.name();
  }
  EXPECT_EQ(sample_density(states(), 158.0), 0.0);
  EXPECT_EQ(sample_density(loops(), 158.0), 1.0);
}

// The evaluator's frequencies extend far beyond it.
TEST(StateSpaceLoop, HasItsPeaksBelowTheNyquistFrequency) {
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant);
  const plant::PointResponse point_response(plant);
  const double nyquist = nyquist_frequency(states());
  int images = 0;
  for (double factor = 0.5; factor < 12.0; factor *= 1.5) {
    const Controller controller = states_without_lag(factor);
    const auto& response = evaluator.response();
    const auto sensitivity = [&](Eigen::Index i) {
      return 1.0 /
             std::abs(1.0 + loop_gain(plant::point(response, i), response.frequency[i], controller,
                                      reference::delay, LoopBreak::valve_command));
    };
    for (Eigen::Index i = 1; i + 1 < response.frequency.size(); ++i) {
      const bool beyond = response.frequency[i] > nyquist && sensitivity(i) > 1.0;
      images += static_cast<int>(beyond && sensitivity(i) > sensitivity(i - 1) &&
                                 sensitivity(i) > sensitivity(i + 1));
    }
    const LoopEvaluation evaluation = evaluator.evaluate(controller, false);
    double highest = 1.0;
    for (Eigen::Index i = 0; response.frequency[i] < nyquist; ++i) {
      highest = std::max(highest, sensitivity(i));
    }
    EXPECT_GE(evaluation.highest_peak(LoopBreak::valve_command), (1.0 - 1e-9) * highest) << factor;
    for (const auto& peak : evaluation.peaks[static_cast<std::size_t>(LoopBreak::valve_command)]) {
      EXPECT_LT(peak.frequency, nyquist) << factor;
      const auto there = loop_gain(point_response(peak.frequency), peak.frequency, controller,
                                   reference::delay, LoopBreak::valve_command);
      EXPECT_NEAR(peak.magnitude * std::abs(1.0 + there), 1.0, 1e-6) << factor;
    }
  }
  EXPECT_GT(images, 2);
}

TEST(StateSpaceLoop, IsBrokenAtTheValveCommandAlone) {
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant);
  const auto evaluation = evaluator.evaluate(states(), false);
  const auto bounds = sensitivity_bounds(plant, states(), reference::delay);
  for (const LoopBreak cut : loop_breaks) {
    const auto b = static_cast<std::size_t>(cut);
    if (cut == LoopBreak::valve_command) {
      EXPECT_TRUE(has_break(states(), cut));
      EXPECT_GT(bounds.at(b).lower, 1.05);
      EXPECT_NEAR(bounds.at(b).upper / bounds.at(b).lower, 1.0, 1e-6);
      EXPECT_NEAR(evaluation.highest_peak(cut) / bounds.at(b).lower, 1.0, 5e-3);
    } else {
      EXPECT_FALSE(has_break(states(), cut));
      EXPECT_TRUE(has_break(loops(), cut));
      EXPECT_EQ(evaluation.highest_peak(cut), 1.0);
      EXPECT_EQ(bounds.at(b).upper, 1.0);
    }
  }
}

// The bound of the exact loop against its own response, aliases and all.
TEST(StateSpaceLoop, PeakIsThatOfTheSampledResponse) {
  const auto plant = reference::antenna();
  const auto bound = sensitivity_bounds(plant, states(), reference::delay)[1];
  ControlledAntenna antenna(plant, *states().structure.state_space(), 0.0);
  const auto sensitivity = [&](double w) {
    return 1.0 / std::abs(1.0 + antenna.at(w).loop_gain[1]);
  };
  EXPECT_NEAR(sensitivity(bound.frequency) / bound.lower, 1.0, 1e-6);
  for (double w = 0.01; w < 150.0; w *= 1.01) EXPECT_LE(sensitivity(w), bound.upper * (1.0 + 1e-9));
}

TEST(StateSpaceLoop, StabilityIsThatOfTheSampledLoop) {
  const auto plant = reference::antenna();
  const Eigen::ArrayXd grid = Eigen::ArrayXd::LinSpaced(200, -5.0, 5.0).exp();
  const auto expected = stability(plant, loops(), reference::delay, grid);
  const auto found = stability(plant, states(), reference::delay, grid);
  EXPECT_TRUE(found.stable());
  EXPECT_NEAR(found.closed_loop_abscissa / expected.closed_loop_abscissa, 1.0, 0.02);
  // By the encirclements of the one and the eigenvalues of the other.
  auto evaluator = reference::loop_evaluator(plant);
  int stable_ones = 0;
  for (double factor = 0.25; factor < 40.0; factor *= 1.3) {
    const bool stable = stability(plant, states(factor), reference::delay, grid).stable();
    EXPECT_EQ(evaluator.evaluate(states(factor), false).stable(), stable) << factor;
    stable_ones += static_cast<int>(stable);
  }
  EXPECT_GT(stable_ones, 2);
  EXPECT_LT(stable_ones, 18);
}

// As verification compares them: noise white to far beyond the loop.
TEST(StateSpaceLoop, RmsOfTheCovarianceIsThatOfTheSpectrum) {
  const auto plant = reference::antenna();
  auto noise = reference::sensor_noise();
  const auto filter = reference::wind_filter(8);
  const double widening = std::sqrt(100.0 / noise.bandwidth);
  for (double* rms : {&noise.encoder_rms, &noise.tachometer_rms, &noise.torque_rms}) {
    *rms *= widening;
  }
  noise.bandwidth = 100.0;
  const Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-4, 100.0, 300);
  LoopEvaluator evaluator(plant, w,
                          {.delay = reference::delay,
                           .noise = noise,
                           .wind_spectrum = (w / two_pi).unaryExpr([](double f) {
                             return reference::motor_wind_spectrum(f);
                           })});
  for (const Controller& controller : {states(), states_with_torque()}) {
    const auto spectrum = evaluator.evaluate(controller, false);
    const auto covariance = lyapunov_rms(plant, controller, reference::delay, filter, noise);
    ASSERT_TRUE(spectrum.stable());
    EXPECT_NEAR(covariance.total / std::sqrt(spectrum.boresight_variance()), 1.0, 5e-3);
    EXPECT_NEAR(covariance.noise / std::sqrt(spectrum.noise_variance), 1.0, 5e-3);
  }
}

}  // namespace
}  // namespace boresight::control
