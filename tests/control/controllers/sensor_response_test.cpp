#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/controllers/sensor_response.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;

constexpr double sample_time = 0.02;

Controller loops() {
  return {LoopStructure::named("FULL+L+C"), {3.0, 8.0, 40.0, 0.5, 30.0, 5.0, 1.5, 15.0, 0.01, 0.3}};
}

plant::StateSpace sampled() {
  return plant::subsystem(sampled_controller(loops(), sample_time),
                          {"motor_torque", "encoder", "tachometer"}, {"valve_demand"});
}

TEST(SensorResponse, IsThatAtTheUnitCircleWithTheHold) {
  const plant::StateSpace system = sampled();
  const SensorResponse response(system);
  for (const double w : {1e-4, 0.03, 1.0, 12.0, 100.0, 157.0, 400.0}) {
    const auto found = response.at(w);
    const Eigen::MatrixXcd expected = plant::frequency_response(system, w);
    const double half = 0.5 * w * sample_time;
    const double hold = std::sin(half) / half;
    // The system reads them in another order.
    const std::array columns{2, 1, 0};
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::complex<double> value = hold * expected(0, columns.at(k));
      EXPECT_LT(std::abs(found.at(k) - value), 1e-10 * std::abs(value)) << w << ' ' << k;
    }
  }
}

TEST(SensorResponse, OfASensorThatIsNotReadIsZero) {
  const SensorResponse response(
      plant::subsystem(sampled(), {"tachometer", "encoder"}, {"valve_demand"}));
  EXPECT_EQ(response.at(1.0)[2], 0.0);
  EXPECT_NE(response.at(1.0)[0], 0.0);
}

// Tustin's method maps the frequency axis onto the unit circle.
TEST(SensorResponse, GivesTheCompensatorsOfTheLoopsThatItIsOf) {
  const Controller states = state_space_controller("states", sampled());
  for (const double w : {0.01, 0.3, 2.0, 60.0}) {
    const double half = 0.5 * w * sample_time;
    const auto found = compensator_response(states, w);
    const auto expected =
        compensator_response(prewarped(loops(), sample_time), 2.0 / sample_time * std::tan(half));
    const auto close = [&](std::complex<double> x, std::complex<double> y) {
      EXPECT_LT(std::abs(x - y), 1e-9 * std::abs(y)) << w;
    };
    const double hold = std::sin(half) / half;
    close(found.rate, hold * expected.rate);
    close(found.position * found.rate, hold * expected.rate * expected.position);
    close(found.pressure,
          hold * (expected.pressure - expected.rate * expected.position * expected.compliance));
    EXPECT_EQ(found.compliance, 0.0);
  }
}

TEST(LoopStructure, OfAStateSpaceHasPartsButNoGains) {
  const LoopStructure structure = LoopStructure::of_state_space("states", sampled());
  EXPECT_TRUE(structure.gains().empty());
  EXPECT_TRUE(structure.blocks().empty());
  EXPECT_EQ(structure.parts(), static_cast<std::size_t>(sampled().a.rows()));
  EXPECT_TRUE(structure.feeds_torque_back());
  EXPECT_EQ(loops().structure.parts(), 10U);
  EXPECT_EQ(loops().structure.state_space(), nullptr);
  auto other = sampled();
  other.d(0, 1) += 1e-9;
  EXPECT_TRUE(structure == LoopStructure::of_state_space("states", sampled()));
  EXPECT_FALSE(structure == LoopStructure::of_state_space("states", other));
  EXPECT_FALSE(structure == loops().structure);
  const auto smaller = plant::subsystem(sampled_controller(reference::lag_loops(), sample_time),
                                        {"tachometer", "encoder"}, {"valve_demand"});
  EXPECT_FALSE(
      LoopStructure::of_state_space("states", smaller) ==
      LoopStructure::of_state_space(
          "states", plant::subsystem(sampled(), {"tachometer", "encoder"}, {"valve_demand"})));
}

TEST(Controller, OfAStateSpaceTimesAFactorIsThatMuchOfItsOutput) {
  const Controller whole = state_space_controller("states", sampled());
  const Controller half = with_output_times(0.5, whole);
  EXPECT_EQ(half.structure.name(), "states");
  for (const double w : {0.1, 3.0, 40.0}) {
    EXPECT_LT(
        std::abs(compensator_response(half, w).rate - 0.5 * compensator_response(whole, w).rate),
        1e-12 * std::abs(compensator_response(whole, w).rate));
  }
  EXPECT_TRUE(with_output_times(1.0, whole).structure == whole.structure);
  EXPECT_THROW(with_output_times(0.5, loops()), InvalidInput);
}

TEST(LoopStructure, RefusesAStateSpaceWithOtherPorts) {
  const auto refused = [](const plant::StateSpace& system, const char* why) {
    EXPECT_THAT(reference::Call([&] { LoopStructure::of_state_space("mine", system); }),
                testing::ThrowsMessage<InvalidInput>(HasSubstr(why)));
  };
  refused(plant::renamed(sampled(), {{"encoder", "resolver"}}), "expected the inputs tachometer");
  refused(plant::renamed(sampled(), {{"valve_demand", "rate"}}), "the output valve_demand");
  refused(plant::subsystem(sampled(), {"encoder"}, {"valve_demand"}), "found encoder -> ");
  auto deaf = sampled();
  deaf.b.col(2).setZero();
  deaf.d.col(2).setZero();
  refused(deaf, "answers the tachometer, found a zero column");
  auto continuous = sampled();
  continuous.sample_time = 0.0;
  refused(continuous, "expected a sampled state space");
}

// Tustin's method takes the continuous form back to where it came from.
TEST(Controller, ContinuousFormOfAStateSpaceIsThatOfTustin) {
  const Controller states = state_space_controller("states", sampled());
  const plant::StateSpace again =
      plant::sample(to_state_space(states), sample_time, plant::SamplingMethod::tustin);
  const plant::StateSpace expected = with_rate_command(sampled());
  EXPECT_EQ(again.inputs, expected.inputs);
  EXPECT_EQ(again.outputs, expected.outputs);
  for (const double w : {0.1, 3.0, 90.0}) {
    const Eigen::MatrixXcd found = plant::frequency_response(again, w);
    const Eigen::MatrixXcd wanted = plant::frequency_response(expected, w);
    EXPECT_LT((found - wanted).norm(), 1e-10 * wanted.norm()) << w;
  }
}

}  // namespace
}  // namespace boresight::control
