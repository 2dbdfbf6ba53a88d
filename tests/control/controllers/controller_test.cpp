#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using reference::relative_error;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Complex = std::complex<double>;

const std::vector<LoopStructure> structures = [] {
  auto all = reference::loop_structures();
  all.push_back(LoopStructure::named("FULL+L+C"));
  all.push_back(LoopStructure::named("LL+L+D+C"));
  return all;
}();

TEST(CompensatorResponse, IsTheFormulaOfTheStructure) {
  const double kr = 0.7, wi = 0.9, wp = 5.0, kp = 0.4, wip = 0.07;
  for (const double w : {1e-3, 0.1, 2.0, 150.0}) {
    const Complex s{0.0, w};
    const Complex pi = kr * (1.0 + wi / s);
    const Complex position = kp * (1.0 + wip / s);
    const auto without = compensator_response({LoopStructure::pi(), {kr, wi, kp, wip}}, w);
    const auto with =
        compensator_response({LoopStructure::pi_with_lag(), {kr, wi, wp, kp, wip}}, w);
    EXPECT_LT(relative_error(without.rate, pi), 1e-14);
    EXPECT_LT(relative_error(with.rate, pi / (1.0 + s / wp)), 1e-14);
    EXPECT_LT(relative_error(without.position, position), 1e-14);
    EXPECT_LT(relative_error(with.position, position), 1e-14);
  }
}

TEST(CompensatorResponse, IsThatOfTheStateSpace) {
  reference::RandomNumbers random(101);
  for (const auto& structure : structures) {
    for (int trial = 0; trial < 50; ++trial) {
      const Controller controller = reference::random_controller(random, structure);
      const double w = random.log_uniform(1e-3, 200.0);
      const auto expected = compensator_response(controller, w);
      const auto system = to_state_space(controller);
      const Eigen::MatrixXcd found = plant::frequency_response(system, w);
      const auto element = [&](const char* output, const char* input) {
        return found(plant::output_index(system, output), plant::input_index(system, input));
      };
      EXPECT_LT(relative_error(element("valve_demand", "tachometer"), -expected.rate), 1e-11);
      EXPECT_LT(relative_error(element("valve_demand", "rate_disturbance"), expected.rate), 1e-11);
      EXPECT_LT(
          relative_error(element("valve_demand", "encoder"), -expected.rate * expected.position),
          1e-11);
      EXPECT_LT(relative_error(element("rate_command", "encoder"), -expected.position), 1e-11);
      EXPECT_LT(std::abs(element("rate_command", "tachometer")), 1e-12 * found.norm());
      if (!structure.has(LoopPath::pressure) && !structure.has(LoopPath::compliance)) {
        EXPECT_EQ(expected.pressure, 0.0);
        EXPECT_EQ(expected.compliance, 0.0);
        continue;
      }
      const Complex of_torque =
          expected.rate * expected.position * expected.compliance - expected.pressure;
      EXPECT_LT(std::abs(element("valve_demand", "motor_torque") - of_torque),
                1e-11 * (std::abs(expected.pressure) +
                         std::abs(expected.rate * expected.position * expected.compliance)));
      const auto rate = rate_loop_controller(controller);
      const Eigen::MatrixXcd alone = plant::frequency_response(rate, w);
      EXPECT_LT(relative_error(alone(0, 0), -expected.rate), 1e-11);
      if (structure.has(LoopPath::pressure)) {
        EXPECT_LT(relative_error(alone(0, 1), -expected.pressure), 1e-11);
      }
    }
  }
}

// Far below every corner R P is the static gain, or grows without bound with an integral.
TEST(StaticEncoderGain, IsTheResponseToTheEncoderAtRest) {
  reference::RandomNumbers random(102);
  for (const auto& structure : structures) {
    const Controller drawn = reference::random_controller(random, structure);
    const bool conditional = structure.has_conditional_integral();
    const Controller controller = conditional ? without_conditional_integral(drawn) : drawn;
    const auto at_rest = compensator_response(controller, 1e-9);
    const double found = static_encoder_gain(drawn);
    EXPECT_EQ(structure.has_integral_action(), std::isinf(found)) << structure.name();
    if (std::isinf(found)) {
      EXPECT_GT(std::abs(at_rest.rate * at_rest.position), 1e3);
    } else {
      EXPECT_LT(relative_error(found, std::abs(at_rest.rate * at_rest.position)), 1e-12);
    }
  }
  const double leaky = static_encoder_gain(reference::lag_loops());
  EXPECT_LT(relative_error(static_encoder_gain(reference::lag_loops_as_state_space()), leaky),
            1e-12);
  auto integrating = *reference::lag_loops_as_state_space().structure.state_space();
  integrating.a.row(0).setZero();
  integrating.a(0, 0) = 1.0;
  EXPECT_TRUE(std::isinf(static_encoder_gain(state_space_controller("integrating", integrating))));
}

TEST(CompensatorResponse, HasTheLogarithmicDerivativesOfItsGains) {
  reference::RandomNumbers random(102);
  for (const auto& structure : structures) {
    for (int trial = 0; trial < 20; ++trial) {
      const Controller controller = reference::random_controller(random, structure);
      const double w = random.log_uniform(1e-3, 200.0);
      const auto response = compensator_response(controller, w);
      for (std::size_t k = 0; k < controller.gains.size(); ++k) {
        const auto difference = [&](double step) {
          Controller up = controller, down = controller;
          up.gains[k] *= std::exp(step);
          down.gains[k] *= std::exp(-step);
          const auto above = compensator_response(up, w), below = compensator_response(down, w);
          // A gain moves its own path alone.
          Complex derivative = 0.0;
          for (const auto path :
               {&CompensatorResponse::rate, &CompensatorResponse::pressure,
                &CompensatorResponse::position, &CompensatorResponse::compliance}) {
            if (above.*path != below.*path) {
              derivative += std::log(above.*path / (below.*path)) / (2.0 * step);
            }
          }
          return derivative;
        };
        // Two step widths, extrapolated to none.
        const Complex derivative = (4.0 * difference(2e-5) - difference(4e-5)) / 3.0;
        EXPECT_LT(std::abs(response.by_gain[k] - derivative), 2e-9 * (1.0 + std::abs(derivative)))
            << k;
      }
    }
  }
}

TEST(GainDescriptions, CoverTheBoundsOfTheStructures) {
  EXPECT_EQ(gain_descriptions(LoopStructure::pi()).size(), 4u);
  EXPECT_EQ(gain_descriptions(LoopStructure::pi_with_lag()).size(), 5u);
  EXPECT_EQ(gain_descriptions(LoopStructure::full().with_compliance_compensation()).size(), 10u);
  for (const auto& structure : structures) {
    for (const auto& description : gain_descriptions(structure)) {
      EXPECT_GT(description.lower, 0.0);
      EXPECT_GT(description.upper, description.lower);
      EXPECT_FALSE(description.unit.empty());
    }
  }
  EXPECT_NE(to_string(LoopStructure::pi()), to_string(LoopStructure::pi_with_lag()));
}

TEST(LoopStructure, PositionLagReplacesTheIntegrals) {
  const auto lag = LoopStructure::named("FULL+L+N+C");
  EXPECT_EQ(lag.name(),
            "P with lead, lag and pressure feedback, position lag, notch, compliance compensation");
  EXPECT_EQ(LoopStructure::full().count(LoopPath::position, BlockKind::integral), 1);
  EXPECT_EQ(lag.count(LoopPath::position, BlockKind::integral), 0);
  EXPECT_EQ(lag.count(LoopPath::rate, BlockKind::integral), 0);
  const double kr = 0.7, kp = 0.4, wpp = 0.2, wzp = 3.0;
  const Controller controller{LoopStructure::named("PI-0+L"), {kr, kp, wpp, wzp}};
  for (const double w : {1e-4, 0.1, 2.0, 150.0}) {
    const Complex s{0.0, w};
    const auto response = compensator_response(controller, w);
    EXPECT_LT(relative_error(response.rate, kr), 1e-14);
    EXPECT_LT(relative_error(response.position, kp * (1.0 + s / wzp) / (1.0 + s / wpp)), 1e-14);
  }
  EXPECT_THROW(lag.with_position_lag(), InvalidInput);
  EXPECT_THROW(LoopStructure::named("PI+N+L"), InvalidInput);
}

TEST(LoopStructure, MovesItsBoundsByTheDecadesOfTheLoad) {
  const auto usual = LoopStructure::named("FULL+N+C");
  // Anything near the usual load keeps the very numbers.
  const auto same = usual.with_bounds_for({1.2, 0.8});
  // kT by 1/(5 x 0.0025) = 80 and cs by 1/(25 x 0.0025) = 16.
  const auto other = usual.with_bounds_for({10.0, 0.001});
  EXPECT_EQ(other.name(), usual.name());
  for (std::size_t k = 0; k < usual.gains().size(); ++k) {
    const auto& gain = usual.gains()[k];
    EXPECT_EQ(same.gains()[k].lower, gain.lower);
    EXPECT_EQ(same.gains()[k].upper, gain.upper);
    const double moved = gain.unit == "1" ? 1.0 : gain.symbol == "kT" ? 100.0 : 10.0;
    EXPECT_DOUBLE_EQ(other.gains()[k].lower, moved * gain.lower) << gain.symbol;
    EXPECT_DOUBLE_EQ(other.gains()[k].upper, moved * gain.upper) << gain.symbol;
  }
  EXPECT_THAT(reference::Call([&] {
                usual.with_bounds_for({0.0, 1.0});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 0 Hz and 1 kg.m2")));
}

TEST(Controller, GivesItsGainsBySymbol) {
  const Controller controller{LoopStructure::pi_with_lag(), {1, 2, 3, 4, 5}};
  EXPECT_EQ(gain(controller, "wp"), 3.0);
  EXPECT_EQ(gain(controller, "wip"), 5.0);
  EXPECT_THAT(reference::Call([] {
                gain({LoopStructure::pi(), {1, 2, 3, 4}}, "wp");
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("has no gain 'wp'")));
}

TEST(Controller, NamesTheGainItRefuses) {
  EXPECT_THAT(reference::Call([] {
                validate({LoopStructure::pi(), {1, 2, 3}});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected 4 gains for PI without lag")));
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    const Controller controller{LoopStructure::pi_with_lag(), {1, 2, 3, bad, 5}};
    EXPECT_THAT(reference::Call([&] { validate(controller); }),
                ThrowsMessage<InvalidInput>(HasSubstr("positive finite position gain")));
    EXPECT_THROW(to_state_space(controller), InvalidInput);
  }
}

}  // namespace
}  // namespace boresight::control
