#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double sample_time = 0.02;

Controller pi_controller() {
  return {LoopStructure::pi_with_lag(), {0.16, 0.42, 2.6, 10.0, 0.24}};
}

Controller full_controller() {
  return {LoopStructure::full().with_compliance_compensation(),
          {0.3, 0.5, 4.0, 20.0, 0.02, 3.0, 5.0, 0.1, 1e-3, 2.0}};
}

plant::FrictionCurve friction_curve() {
  return {.coulomb_torque = 10.0,
          .breakaway_torque = 17.0,
          .stribeck_rate = 0.2,
          .saturating_torque = 60.0,
          .saturating_rate = 1.5,
          .viscous_friction = 2.0};
}

VectorXd vector(std::initializer_list<double> values) {
  VectorXd result(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

TEST(AntennaController, ReadsWhatItsControllerFeedsBack) {
  EXPECT_THAT(AntennaController(pi_controller(), sample_time).inputs(),
              ElementsAre("tachometer", "encoder", "reference", "reference_rate",
                          "reference_acceleration"));
  EXPECT_THAT(AntennaController(full_controller(), sample_time).inputs(),
              ElementsAre("tachometer", "encoder", "motor_torque", "reference", "reference_rate",
                          "reference_acceleration"));
  EXPECT_THAT(AntennaController(pi_controller(), sample_time).outputs(),
              ElementsAre("valve_command"));
  EXPECT_EQ(AntennaController(pi_controller(), sample_time).sample_time(), sample_time);
}

TEST(AntennaController, WithinItsLimitItIsTheSampledController) {
  const auto controller = sampled_controller(full_controller(), sample_time);
  plant::LinearSampledController linear(controller);
  AntennaController antenna_controller(full_controller(), sample_time);
  reference::RandomNumbers random(3);
  VectorXd expected(2), found(1);
  for (int k = 0; k < 200; ++k) {
    const double tachometer = random.uniform(-1.0, 1.0), encoder = random.uniform(-1.0, 1.0);
    const double torque = random.uniform(-9.0, 9.0), reference = random.uniform(-1.0, 1.0);
    VectorXd measured(5);
    measured[plant::input_index(controller, "tachometer")] = tachometer;
    measured[plant::input_index(controller, "encoder")] = encoder;
    measured[plant::input_index(controller, "motor_torque")] = torque;
    measured[plant::input_index(controller, "angle_reference")] = reference;
    measured[plant::input_index(controller, "rate_disturbance")] = 0.0;
    linear.update(0.0, measured, expected);
    antenna_controller.update(0.0, vector({tachometer, encoder, torque, reference, 5.0, 7.0}),
                              found);
    ASSERT_NEAR(found[0], expected[plant::output_index(controller, "valve_demand")], 1e-10);
  }
}

TEST(AntennaController, FeedforwardActsWhereItSays) {
  AntennaControllerOptions options;
  options.feedforward = {1.0, -0.01, 1.1, 0.3};
  AntennaController with(pi_controller(), sample_time, options),
      without(pi_controller(), sample_time);
  VectorXd expected(1), found(1);
  // A rate command is as good as a tachometer's error of the other sign.
  for (int k = 0; k < 20; ++k) {
    const double rate = 0.1 * k, acceleration = 2.0 - 0.3 * k;
    with.update(0.0, vector({0.5, 0.2, 0.1, rate, acceleration}), found);
    without.update(0.0, vector({0.5 - (rate - 0.01 * acceleration), 0.2, 0.1, 0.0, 0.0}), expected);
    EXPECT_NEAR(found[0], expected[0] + 1.1 * rate + 0.3 * acceleration, 1e-12);
  }
}

TEST(AntennaController, KeepsToItsLimitAndUnwinds) {
  const double limit = 3.0;
  VectorXd command(1);
  const auto samples_to_leave = [&](bool anti_windup) {
    AntennaController antenna_controller(pi_controller(), sample_time,
                                         {.command_limit = limit, .anti_windup = anti_windup});
    for (int k = 0; k < 1000; ++k) {
      antenna_controller.update(0.0, vector({0.0, 0.0, 5.0, 0.0, 0.0}), command);
      EXPECT_LE(std::abs(command[0]), limit);
    }
    EXPECT_EQ(command[0], limit);
    int k = 0;
    for (; k < 100000 && command[0] == limit; ++k) {
      antenna_controller.update(0.0, vector({0.0, 5.5, 5.0, 0.0, 0.0}), command);
    }
    return k;
  };
  EXPECT_EQ(AntennaController(pi_controller(), sample_time).back_calculation_fraction(), 1.0);
  EXPECT_EQ(AntennaController(pi_controller(), sample_time, {.anti_windup = false})
                .back_calculation_fraction(),
            0.0);
  EXPECT_LT(10 * samples_to_leave(true), samples_to_leave(false));
}

TEST(AntennaController, BackCalculationIsStableForEveryController) {
  reference::RandomNumbers random(5);
  for (int trial = 0; trial < 40; ++trial) {
    Controller controller{trial % 2 == 0 ? LoopStructure::full() : LoopStructure::pi(), {}};
    for (const auto& gain : controller.structure.gains()) {
      controller.gains.push_back(random.log_uniform(gain.lower, gain.upper));
    }
    AntennaController antenna_controller(controller, sample_time, {.command_limit = 1.0});
    ASSERT_GT(antenna_controller.back_calculation_fraction(), 0.0) << trial;
    // At the limit for an hour: the controller's answer does not grow.
    const auto measured = controller.structure.has(LoopPath::pressure)
                              ? vector({0.0, 0.0, 0.0, 1.0, 0.0, 0.0})
                              : vector({0.0, 0.0, 1.0, 0.0, 0.0});
    VectorXd command(1);
    for (int k = 0; k < 180000; ++k) antenna_controller.update(0.0, measured, command);
    ASSERT_TRUE(std::isfinite(command[0]));
  }
}

TEST(AntennaController, HoldsTheMotionThatItIsStartedFrom) {
  const auto plant = reference::antenna();
  for (const bool feedforward : {false, true}) {
    for (const auto& controller : {pi_controller(), full_controller()}) {
      AntennaControllerOptions options;
      if (feedforward) options.feedforward = plant_feedforward(plant, controller, 0.03);
      AntennaController antenna_controller(controller, sample_time, options);
      const double lead = antenna_controller.start_from({4.0, 2.0, 60.0});
      const bool compliance = controller.structure.has(LoopPath::compliance);
      EXPECT_NEAR(lead, compliance ? 1e-3 * 60.0 : 0.0, 1e-12);
      antenna_controller.restart();
      VectorXd command(1);
      for (int k = 0; k < 500; ++k) {
        const double reference = 2.0 * sample_time * k;
        antenna_controller.update(0.0,
                                  compliance
                                      ? vector({2.0, reference + lead, 60.0, reference, 2.0, 0.0})
                                      : vector({2.0, reference + lead, reference, 2.0, 0.0}),
                                  command);
        ASSERT_NEAR(command[0], 4.0, 1e-9) << controller.structure.name() << " at sample " << k;
      }
    }
  }
}

TEST(PlantFeedforward, IsTheInverseOfThePlantAtLowFrequencies) {
  auto plant = reference::antenna();
  plant.drive.viscous_friction = 6.0;
  const double delay = 0.03;
  const auto forward = plant_feedforward(plant, pi_controller(), delay);
  // Motor rate by valve command at s = j w, and the dead time before it: u/rate = v + a s.
  auto system = plant::to_state_space(plant);
  const double w = 1e-3;
  const auto tachometer = plant::frequency_response(system, w)(0, 0);
  const std::complex<double> s{0.0, w};
  const auto inverse =
      std::exp(s * delay) / (tachometer * (1.0 + s / plant.drive.tachometer_corner));
  EXPECT_NEAR(inverse.real(), forward.rate_to_valve_command, 1e-5);
  EXPECT_NEAR(inverse.imag() / w, forward.acceleration_to_valve_command, 1e-4);
  EXPECT_EQ(forward.rate_to_rate_command, 1.0);
  EXPECT_NEAR((1.0 / (1.0 + s / plant.drive.tachometer_corner)).imag() / w,
              forward.acceleration_to_rate_command, 1e-8);
  // A washed-out pressure path takes kT/wd of the torque's rate off.
  const Controller damped{LoopStructure::pressure_feedback(),
                          {0.16, 0.42, 2.6, 0.05, 2.5, 10.0, 0.24}};
  EXPECT_NEAR(plant_feedforward(plant, damped, delay).acceleration_to_valve_command -
                  forward.acceleration_to_valve_command,
              0.05 / 2.5 * 6.0, 1e-9);
}

TEST(AntennaController, RefusesWhatItCannotDo) {
  const auto message = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(
      message([] { AntennaController(pi_controller(), sample_time, {.command_limit = 0.0}); }),
      HasSubstr("a command limit and a supply torque above 0 and finite feedforward, found a "
                "limit of 0 rad/s"));
  EXPECT_THAT(message([] {
                AntennaController(
                    pi_controller(), sample_time,
                    {.feedforward = {std::numeric_limits<double>::infinity(), 0.0, 0.0, 0.0}});
              }),
              HasSubstr("finite feedforward"));
  EXPECT_THAT(message([] {
                AntennaController(pi_controller(), sample_time,
                                  {.feedforward = {.supply_torque = 0.0}});
              }),
              HasSubstr("supply torque above 0"));
  EXPECT_THAT(message([] { with_friction({}, reference::antenna(), friction_curve(), -0.5); }),
              HasSubstr("a fraction of the friction torque of 0 or more, found -0.5"));
  EXPECT_THAT(message([] { AntennaController(pi_controller(), 0.0); }),
              HasSubstr("sample time above 0"));
  EXPECT_THAT(message([] { plant_feedforward(reference::antenna(), pi_controller(), -1.0); }),
              HasSubstr("expected a delay of 0 or more, found -1"));
}

// Without integrals, as a state space must be stable by itself.
Controller leaky_controller() {
  return {LoopStructure::named("FULL+L+C"), {3.0, 8.0, 40.0, 0.5, 30.0, 5.0, 1.5, 15.0, 0.01, 0.3}};
}

Controller as_state_space(const Controller& controller) {
  return state_space_controller(
      "sampled", plant::subsystem(sampled_controller(controller, sample_time),
                                  {"motor_torque", "encoder", "tachometer"}, {"valve_demand"}));
}

// The loops and the same controller as a state space: in motion too, as the commanded rate is taken
// off the tachometer's.
TEST(AntennaController, AsAStateSpaceItIsTheSameController) {
  AntennaControllerOptions options;
  options.feedforward = {1.0, -0.02, 1.1, 0.3};
  AntennaController loops(leaky_controller(), sample_time, options);
  AntennaController states(as_state_space(leaky_controller()), sample_time, options);
  EXPECT_EQ(states.inputs(), loops.inputs());
  const SteadyMotion motion{0.3, 0.2, 12.0};
  const double lead = loops.start_from(motion);
  EXPECT_NEAR(states.start_from(motion), lead, 1e-9 * std::abs(lead));
  reference::RandomNumbers random(5);
  VectorXd expected(1), found(1);
  for (int k = 0; k < 200; ++k) {
    VectorXd measured(6);
    for (double& value : measured) value = random.uniform(-1.0, 1.0);
    loops.update(0.0, measured, expected);
    states.update(0.0, measured, found);
    ASSERT_NEAR(found[0], expected[0], 1e-9 * (1.0 + std::abs(expected[0]))) << k;
  }
}

TEST(AntennaController, AStateSpaceSeesTheTorqueBeyondThatOfItsMotion) {
  AntennaControllerOptions options;
  options.feedforward.rate_to_motor_torque = 5.0;
  options.feedforward.acceleration_to_motor_torque = 0.4;
  AntennaController with(as_state_space(leaky_controller()), sample_time, options);
  AntennaController without(as_state_space(leaky_controller()), sample_time);
  VectorXd found(1), expected(1);
  with.update(0.0, vector({0.0, 0.0, 7.0 + 5.0 * 2.0 + 0.4 * 3.0, 0.0, 2.0, 3.0}), found);
  without.update(0.0, vector({0.0, 0.0, 7.0, 0.0, 2.0, 3.0}), expected);
  EXPECT_NE(expected[0], 0.0);
  EXPECT_NEAR(found[0], expected[0], 1e-12 * std::abs(expected[0]));
}

TEST(PlantFeedforward, HasTheTorqueOfTheMotion) {
  const auto plant = reference::antenna();
  for (const Controller& controller : {pi_controller(), as_state_space(leaky_controller())}) {
    const auto forward = plant_feedforward(plant, controller, 0.03);
    EXPECT_EQ(forward.acceleration_to_motor_torque, plant::reflected_inertia(plant));
    EXPECT_EQ(forward.rate_to_motor_torque, plant.drive.viscous_friction);
  }
}

// A torque compresses the oil by T/K of motor angle and leaks by lambda T/K per second, so that the
// sum of the valve commands over a reversal is known whatever the rates between.
TEST(FrictionFeedforward, OpensTheValveForTheOilThatTheTorqueTakes) {
  const auto plant = reference::antenna();
  const double fraction = 0.75;
  AntennaControllerOptions options;
  options.feedforward = with_friction({}, plant, friction_curve(), fraction);
  AntennaController controller(pi_controller(), sample_time, options);
  const auto torque = [&](double rate) {
    return fraction * plant::friction_torque(friction_curve(), rate);
  };
  const double acceleration = 8.0;  // rad/s2
  double sum = 0.0, leaked = 0.0;
  VectorXd command(1);
  // From -2 to 2 rad/s, with one sample at rest between.
  for (int k = -13; k <= 12; ++k) {
    const double rate = std::max(-2.0, acceleration * sample_time * k);
    const double next = std::max(-2.0, acceleration * sample_time * (k + 1));
    controller.update(0.0, vector({0.0, 0.0, 0.0, rate, (next - rate) / sample_time}), command);
    sum += command[0] * sample_time;
    if (k + 1 != 0) leaked += torque(next) * sample_time;
  }
  const double last = torque(acceleration * sample_time * 13);
  EXPECT_GT(last, 30.0);
  EXPECT_NEAR(sum, (last + plant.drive.leakage_rate * leaked) / plant.drive.oil_stiffness, 1e-12);
  controller.restart();
  controller.update(0.0, vector({0.0, 0.0, 0.0, 0.0, 0.0}), command);
  EXPECT_EQ(command[0], 0.0);
}

// The sensor sees the torque two samples after the command for it was computed.
TEST(FrictionFeedforward, IsSubtractedFromTheMeasuredTorque) {
  const auto plant = reference::antenna();
  AntennaControllerOptions options;
  options.feedforward = with_friction({}, plant, friction_curve(), 1.0);
  AntennaController with(full_controller(), sample_time, options);
  AntennaController without(full_controller(), sample_time);
  const double torque = plant::friction_torque(friction_curve(), 3.0);
  const double K = plant.drive.oil_stiffness;
  VectorXd found(1), expected(1);
  for (int k = 0; k < 6; ++k) {
    with.update(0.0, vector({0.0, 0.0, k < 2 ? 0.0 : torque, 0.0, 3.0, 0.0}), found);
    without.update(0.0, vector({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}), expected);
    const double built_up = k == 0 ? torque / sample_time : 0.0;
    EXPECT_NEAR(found[0], (plant.drive.leakage_rate * torque + built_up) / K, 1e-12) << k;
    EXPECT_EQ(expected[0], 0.0);
  }
}

TEST(AntennaController, OpensTheValveFurtherUnderLoad) {
  AntennaControllerOptions options;
  options.feedforward.rate_to_valve_command = 1.0;
  options.feedforward.rate_to_motor_torque = 2.0;
  options.feedforward.acceleration_to_motor_torque = 1.5;
  options.feedforward.supply_torque = 300.0;
  AntennaController controller(pi_controller(), sample_time, options);
  VectorXd command(1);
  const auto at = [&](double rate, double acceleration) {
    controller.restart();
    controller.update(0.0, vector({0.0, 0.0, 0.0, rate, acceleration}), command);
    return command[0];
  };
  EXPECT_NEAR(at(40.0, 30.0), 40.0 / std::sqrt(1.0 - 125.0 / 300.0), 1e-12);
  EXPECT_NEAR(at(-40.0, -30.0), -at(40.0, 30.0), 1e-12);
  // Braking: the load drives the flow.
  EXPECT_NEAR(at(40.0, -80.0), 40.0 / std::sqrt(1.0 + 40.0 / 300.0), 1e-12);
  EXPECT_NEAR(at(140.0, 50.0), 140.0 / std::sqrt(0.1), 1e-10);
  EXPECT_EQ(at(0.0, 0.0), 0.0);
}

TEST(AntennaController, TakesOverASteadyMotionWithItsFeedforward) {
  const auto plant = reference::antenna();
  AntennaControllerOptions options;
  for (const Controller& one : {full_controller(), as_state_space(leaky_controller())}) {
    options.feedforward =
        with_friction(plant_feedforward(plant, one, 0.03), plant, friction_curve(), 0.8);
    options.feedforward.supply_torque = 300.0;
    AntennaController controller(one, sample_time, options);
    const SteadyMotion motion{3.4, 3.0, 80.0};
    const double lead = controller.start_from(motion);
    VectorXd command(1);
    for (int k = 0; k < 20; ++k) {
      controller.update(0.0, vector({3.0, 1.0 + lead, 80.0, 1.0, 3.0, 0.0}), command);
      ASSERT_NEAR(command[0], 3.4, 1e-8) << k;
    }
  }
}

TEST(AntennaController, RefusesAStateSpaceThatItCannotRun) {
  const auto refused = [](const Controller& controller, double period, const char* why) {
    EXPECT_THAT(reference::Call([&] { AntennaController(controller, period); }),
                testing::ThrowsMessage<InvalidInput>(HasSubstr(why)));
  };
  refused(as_state_space(leaky_controller()), 0.01, "a sample time of 0.02 s, that of sampled");
  refused(state_space_controller("PI",
                                 plant::subsystem(sampled_controller(pi_controller(), sample_time),
                                                  {"tachometer", "encoder"}, {"valve_demand"})),
          sample_time, "stable by itself");
}

}  // namespace
}  // namespace boresight::control
