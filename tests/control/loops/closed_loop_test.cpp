#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include <boresight/control/controllers/delay.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

const std::vector<LoopStructure> structures = reference::loop_structures();

TEST(ClosedLoop, HasTheResponsesOfTheLoopWrittenOut) {
  const auto plant = reference::antenna();
  const Controller controller{LoopStructure::pi_with_lag(), {0.4, 0.8, 6.0, 0.4, 0.06}};
  const auto loop = closed_loop(plant, controller, reference::delay);
  EXPECT_THAT(loop.inputs, testing::ElementsAre("wind_torque", "encoder_noise", "tachometer_noise",
                                                "rate_disturbance"));
  EXPECT_THAT(loop.outputs, testing::ElementsAre("beam", "encoder", "tachometer", "motor_torque",
                                                 "valve_demand"));
  const auto approximant = delay_approximant(reference::delay, delay_order, "in", "out");
  for (const double w : {0.05, 0.7, 5.0, 14.0, 40.0}) {
    const auto p = plant::plant_response(plant, Eigen::ArrayXd::Constant(1, w));
    const auto c = compensator_response(controller, w);
    const Complex dead_time = plant::frequency_response(approximant, w)(0, 0);
    const Complex r = c.rate * dead_time;
    const Complex whole = 1.0 + r * (p.tachometer_command[0] + c.position * p.encoder_command[0]);
    const Complex measured = p.tachometer_wind[0] + c.position * p.encoder_wind[0];
    const Eigen::MatrixXcd found = plant::frequency_response(loop, w);
    const auto near = [&](Eigen::Index i, Eigen::Index j, Complex expected) {
      EXPECT_LT(std::abs(found(i, j) - expected), 1e-9 * std::abs(expected))
          << loop.outputs[static_cast<std::size_t>(i)] << " from "
          << loop.inputs[static_cast<std::size_t>(j)];
    };
    near(0, 0, p.boresight_wind[0] - p.boresight_command[0] * r * measured / whole);
    near(3, 0, p.torque_wind[0] - p.torque_command[0] * r * measured / whole);
    near(0, 1, -p.boresight_command[0] * r * c.position / whole);
    near(2, 2, -p.tachometer_command[0] * r / whole);
    near(1, 3, p.encoder_command[0] * r / whole);
    near(4, 2, -c.rate / whole);
  }
}

struct RateLoopPoles {
  int count = 0;         // in the right half plane
  double nearest = 1.0;  // |Re|/|pole| of the one nearest to the axis
};

// Rate loop alone with the free angle left in: one eigenvalue at 0 that nothing drives.
RateLoopPoles poles_of_rate_loop(const plant::AntennaPlant& plant, const Controller& controller) {
  const double kr = gain(controller, "kr"), wi = gain(controller, "wi");
  std::vector<plant::StateSpace> parts{
      plant::to_state_space(plant),
      plant::rational({-kr * wi, -kr}, {0.0, 1.0}, "tachometer", "pi", "integrator"),
      delay_approximant(reference::delay, delay_order, "demand", "valve_command")};
  if (controller.structure == LoopStructure::pi_with_lag()) {
    parts.push_back(
        plant::rational({1.0}, {1.0, 1.0 / gain(controller, "wp")}, "pi", "demand", "lag"));
  } else {
    parts.push_back(plant::static_gain(Eigen::MatrixXd::Ones(1, 1), {"pi"}, {"demand"}));
  }
  const auto loop = plant::connect(parts, {"wind_torque"}, {"tachometer"});
  RateLoopPoles result;
  for (const Complex pole : numerics::eigenvalues(loop.a)) {
    if (std::abs(pole) < 1e-6) continue;
    if (pole.real() > 0.0) ++result.count;
    result.nearest = std::min(result.nearest, std::abs(pole.real()) / std::abs(pole));
  }
  return result;
}

TEST(EncirclementCount, CountsTheUnstableEigenvalues) {
  reference::RandomNumbers random(131);
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant);
  const Eigen::ArrayXd residue_grid = plant::frequency_grid(plant, 1e-2, 25.0, 5);
  int stable = 0, disagreements = 0;
  for (const auto& structure : structures) {
    const bool written_out = !structure.has(LoopPath::pressure) &&
                             !structure.has(LoopPath::compliance) && structure.gains().size() < 6;
    for (int trial = 0; trial < 200; ++trial) {
      const Controller controller = reference::random_controller(random, structure);
      const auto evaluation = evaluator.evaluate(controller, false);
      const auto poles = numerics::eigenvalues(closed_loop(plant, controller, reference::delay).a);
      const int closed = static_cast<int>((poles.real().array() > 0.0).count());
      const auto verdict = stability(plant, controller, reference::delay, residue_grid);
      EXPECT_EQ(verdict.closed_loop_abscissa < 0.0, closed == 0);
      // Only a pole nearer to the axis than the grid is fine can be taken for the other side's.
      const double nearest = (poles.real().array() / poles.array().abs()).abs().minCoeff();
      if (evaluation.unstable_closed_loop != closed) {
        EXPECT_LT(nearest, 1e-3) << testing::PrintToString(controller.gains);
        ++disagreements;
      }
      stable += evaluation.stable() ? 1 : 0;
      if (!written_out) {
        if ((evaluation.unstable_rate_loop == 0) != (verdict.rate_loop_abscissa < 0.0)) {
          EXPECT_LT(std::abs(verdict.rate_loop_abscissa), 0.02)
              << structure.name() << testing::PrintToString(controller.gains);
          ++disagreements;
        }
        continue;
      }
      const RateLoopPoles rate = poles_of_rate_loop(plant, controller);
      EXPECT_EQ(verdict.rate_loop_abscissa < 0.0, rate.count == 0);
      if (evaluation.unstable_rate_loop != rate.count) {
        EXPECT_LT(rate.nearest, 1e-3) << testing::PrintToString(controller.gains);
        ++disagreements;
      }
    }
  }
  EXPECT_LE(disagreements, 4);  // of 2800
  EXPECT_GT(stable, 20);
  EXPECT_LT(stable, 1200);
}

TEST(Stability, HoldsForTheExactDeadTime) {
  reference::RandomNumbers random(132);
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant, 100);
  const Eigen::ArrayXd& w = evaluator.response().frequency;
  for (const auto& structure : structures) {
    for (int trial = 0; trial < 20; ++trial) {
      const Controller controller = reference::sound_controller(random, evaluator, structure, 3.0);
      const auto verdict = stability(plant, controller, reference::delay, w);
      EXPECT_TRUE(verdict.stable());
      EXPECT_LT(verdict.dead_time_residue, 1e-3);
    }
  }
}

TEST(Stability, OfTheRateLoopAloneIsItsOwn) {
  // A rate loop past its gain margin is unstable with the position loop open.
  const auto plant = reference::antenna();
  const Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-2, 25.0, 30);
  const auto high = stability(plant, {LoopStructure::pi(), {20.0, 1.0, 0.05, 1e-3}}, 0.03, w);
  EXPECT_GT(high.rate_loop_abscissa, 0.0);
  EXPECT_FALSE(high.stable());
  // A position gain too high for a sound rate loop leaves that one alone.
  const auto position = stability(plant, {LoopStructure::pi(), {0.25, 1.0, 20.0, 0.06}}, 0.03, w);
  EXPECT_LT(position.rate_loop_abscissa, 0.0);
  EXPECT_GT(position.closed_loop_abscissa, 0.0);
  EXPECT_FALSE(position.stable());
}

TEST(Lyapunov, OfTheWindFilterHasTheVarianceOfItsSpectrum) {
  const auto filter = reference::wind_filter(4);
  const auto system = plant::to_state_space(filter, "torque");
  const auto p = solve_lyapunov(system.a, system.b * system.b.transpose()).covariance;
  const double variance = (system.c * p * system.c.transpose())(0, 0);
  double integral = 0.0;
  constexpr int points = 40000;
  const double low = std::log(1e-8), high = std::log(1e6);
  for (int i = 0; i < points; ++i) {
    const double f = std::exp(low + (i + 0.5) * (high - low) / points);
    integral += f * plant::filter_spectrum(filter, f) * (high - low) / points;
  }
  EXPECT_NEAR(variance / integral, 1.0, 1e-5);
}

TEST(LyapunovRms, WithTheWindFilterIsThatOfTheSpectrumItself) {
  // The order-4 filter costs less than 0.2 % of the closed-loop rms; order 1 is far off.
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant);
  const Controller controller{LoopStructure::pi_with_lag(), {0.4, 0.8, 6.0, 0.4, 0.06}};
  const double exact = std::sqrt(evaluator.evaluate(controller, false).wind_variance);
  const auto rms = [&](const plant::ShapingFilter& filter) {
    return lyapunov_rms(plant, controller, reference::delay, filter, reference::sensor_noise());
  };
  const auto four = rms(reference::wind_filter(4));
  EXPECT_NEAR(four.wind / exact, 1.0, 2e-3);
  EXPECT_LT(four.relative_residual, 1e-12);
  EXPECT_NEAR(four.total, std::hypot(four.wind, four.noise), 1e-15);
  const auto one = rms(reference::wind_filter(1));
  EXPECT_GT(std::abs(one.wind / exact - 1.0), 0.1);
}

TEST(LyapunovRms, RefusesAnUnstableLoop) {
  const Controller controller{LoopStructure::pi(), {20.0, 1.0, 0.05, 1e-3}};
  EXPECT_THROW(lyapunov_rms(reference::antenna(), controller, reference::delay,
                            reference::wind_filter(4), reference::sensor_noise()),
               NumericalFailure);
}

}  // namespace
}  // namespace boresight::control
