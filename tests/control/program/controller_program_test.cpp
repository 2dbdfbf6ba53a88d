#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/control/program/controller_program.hpp>
#include <boresight/control/program/interpreter.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control::program {
namespace {

constexpr double sample_time = 0.02;
constexpr double gear_ratio = 28724.0;
constexpr double degree = std::numbers::pi / 180.0;

Controller loops(const std::string& name) {
  Controller controller{LoopStructure::named(name), {}};
  for (const auto& gain : controller.structure.gains()) {
    controller.gains.push_back(std::sqrt(gain.lower * gain.upper));
  }
  return controller;
}

// A pair of poles, a real one, and feedthrough.
Controller state_space() {
  plant::StateSpace system;
  system.a = (Eigen::Matrix3d() << 0.9, 0.2, 0.1, -0.2, 0.9, 0.0, 0.0, 0.0, 0.6).finished();
  system.b = (Eigen::Matrix3d() << 0.3, -0.2, 0.01, 0.1, 0.4, 0.0, -0.2, 0.1, 0.02).finished();
  system.c = Eigen::RowVector3d{-0.4, -0.7, 0.3};
  system.d = Eigen::RowVector3d{-0.5, -0.8, -0.01};
  system.states = {"first", "second", "third"};
  system.inputs = {"tachometer", "encoder", "motor_torque"};
  system.outputs = {"valve_demand"};
  system.sample_time = sample_time;
  return state_space_controller("three states", system);
}

ControllerProgramOptions options_of(bool feedforward = true) {
  ControllerProgramOptions options;
  if (feedforward) {
    options.feedforward = {.rate_to_rate_command = 1.0,
                           .acceleration_to_rate_command = -0.008,
                           .rate_to_valve_command = 1.02,
                           .acceleration_to_valve_command = 0.07,
                           .rate_to_motor_torque = 0.1,
                           .acceleration_to_motor_torque = 1.6,
                           .friction = {20.0, 26.0, 0.3, 4.0, 10.0, 0.15},
                           .friction_to_valve_command = 0.01,
                           .friction_change_to_valve_command = 0.002,
                           .supply_torque = 250.0};
  }
  options.command_limit = 150.0;
  options.limits = {0.25 * degree, 0.2 * degree};
  options.gear_ratio = gear_ratio;
  options.signals = {.encoder_counts = 1 << 20,
                     .encoder_zero = -0.3,
                     .encoder_centre = 1.0,
                     .tachometer = {0.19, "V"},
                     .motor_torque = {0.02, "V"},
                     .valve_command = {10.0 / 150.0, "V"},
                     .largest_rate = 600.0,
                     .largest_torque = 1000.0};
  return options;
}

// The axis as a program's sensors see it: motors that follow the valve with a lag.
struct Axis {
  double angle = 0.9;  // rad at the sky
  double rate = 0.0;   // rad/s of motor
  double torque = 5.0;
  std::mt19937_64 random{7};

  double noise(double size) {
    return size * (static_cast<double>(random() % 20001) / 10000.0 - 1.0);
  }
  void move(double valve) {
    rate += 0.15 * (valve - rate) + noise(0.05);
    torque = 10.0 * (valve - rate) + noise(3.0);
    angle += sample_time * rate / gear_ratio;
  }
  double counts(const ComputerSignals& signals) const {
    const auto turn = static_cast<double>(signals.encoder_counts);
    const double all = std::round((angle - signals.encoder_zero) * turn / (2.0 * std::numbers::pi));
    return all - turn * std::floor(all / turn);
  }
};

class OfController : public testing::TestWithParam<std::string> {
 protected:
  static Controller controller() { return GetParam() == "SS" ? state_space() : loops(GetParam()); }
};

// One follows a target that jumps, the other gets the reference that the first one made of it.
TEST_P(OfController, CommandsValveAsAntennaController) {
  const Controller controller = OfController::controller();
  const ControllerProgramOptions options = options_of();
  const ComputerSignals& signals = options.signals;
  const Program program = controller_program(controller, sample_time, options);
  Interpreter computer(program);
  AntennaController same(
      controller, sample_time,
      {.feedforward = options.feedforward, .command_limit = options.command_limit});
  const bool torque = controller.structure.feeds_torque_back();
  Axis axis;
  Eigen::VectorXd measured(torque ? 6 : 5), command(1);
  double valve = 3.0, largest = 0.0;
  int limited = 0;
  computer.set("command", valve);
  for (int k = 0; k < 4000; ++k) {
    const double counts = axis.counts(signals);
    computer.set("run", 1.0);
    computer.set("encoder_counts", counts);
    computer.set("tachometer", axis.rate * signals.tachometer.scale);
    if (torque) computer.set("pressure_difference", axis.torque * signals.motor_torque.scale);
    const double jump = k < 1500 ? 0.0 : 2.0;
    computer.set("target_angle", 52.0 + jump + 0.004 * sample_time * k);
    computer.set("target_rate", 0.004);
    const double rate_before = computer.get("commanded_rate");
    const double reference_before = computer.get("reference_angle");
    computer.step();
    ASSERT_EQ(computer.get("fault"), 0.0);
    const double encoder = signals.encoder_zero + counts * 2.0 * std::numbers::pi /
                                                      static_cast<double>(signals.encoder_counts);
    double rate = rate_before, reference = reference_before;
    if (k == 0) {
      const double lead = same.start_from({valve, axis.rate, axis.torque});
      reference = (encoder - lead / gear_ratio) / degree;
      rate = axis.rate / gear_ratio / degree;
    }
    const double to_motor = degree * gear_ratio;
    measured.head(2) << axis.rate, encoder * gear_ratio;
    if (torque) measured[2] = axis.torque;
    measured.tail(3) << reference * to_motor, rate * to_motor,
        (computer.get("commanded_rate") - rate) / sample_time * to_motor;
    same.update(0.0, measured, command);
    valve = computer.get("valve_command") / signals.valve_command.scale;
    largest = std::max(largest, std::abs(valve - command[0]));
    if (std::abs(valve) == options.command_limit) ++limited;
    axis.move(valve);
    // A gust that the drive cannot hold: back calculation acts.
    if (k > 2500 && k < 2520) axis.angle += 0.02 * degree;
  }
  EXPECT_LT(largest, 1e-12 * options.command_limit) << "rad/s";
  if (GetParam() == "FULL+L+C") {
    EXPECT_GT(limited, 5);
  }
}

// At rest with a tachometer's noise, in motion, and beyond the rate limit; to any target.
TEST_P(OfController, StartsWithValveCommandInForce) {
  const Controller controller = OfController::controller();
  const ControllerProgramOptions options = options_of();
  const Program program = controller_program(controller, sample_time, options);
  for (const double rate : {0.0, 0.02, -0.02, 22.5, -140.0}) {  // rad/s of motor
    Interpreter computer(program);
    computer.set("encoder_counts", 40000.0);
    computer.set("manual_command", 1.5);
    computer.set("tachometer", rate * options.signals.tachometer.scale);
    computer.step();
    EXPECT_EQ(computer.get("valve_command"), 1.5) << "standby";
    EXPECT_EQ(computer.get("running"), 0.0);
    EXPECT_EQ(computer.get("reference"), computer.get("position"));
    computer.set("run", 1.0);
    computer.set("target_angle", 80.0);
    computer.step();
    EXPECT_NEAR(computer.get("valve_command"), 1.5, 1e-9) << rate;
    EXPECT_EQ(computer.get("running"), 1.0);
    computer.step();
    const double largest_step = 0.2 * degree * sample_time * gear_ratio;
    const double from = std::abs(rate) < 0.15 ? 0.0 : rate;
    EXPECT_NEAR(computer.get("reference_rate") * degree * gear_ratio, from + largest_step, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Structures, OfController,
                         testing::Values("PI-0", "PI", "DPF", "LL", "FULL", "LL+L", "PI+N",
                                         "FULL+L+C", "FULL+N+C", "FULL+D", "LL+F+N", "DPF+L+D+C",
                                         "SS"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::erase_if(name, [](char c) { return c == '+' || c == '-'; });
                           return name;
                         });

TEST(ControllerProgram, ReferenceIsThatOfCommandPreprocessor) {
  const ControllerProgramOptions options = options_of();
  const Program program = controller_program(loops("PI"), sample_time, options);
  Interpreter computer(program);
  computer.set("run", 1.0);
  computer.set("encoder_counts", 5000.0);
  std::optional<CommandPreprocessor> same;
  for (int k = 0; k < 3000; ++k) {
    const double target = k < 1200 ? -12.0 : -14.5 + 0.01 * sample_time * k;
    const double rate = k < 1200 ? 0.0 : 0.01;
    computer.set("target_angle", target);
    computer.set("target_rate", rate);
    if (k == 0) {
      computer.step();
      same.emplace(options.limits, sample_time,
                   CommandSample{computer.get("reference") * degree,
                                 computer.get("reference_rate") * degree, 0.0});
      continue;
    }
    computer.step();
    const CommandSample& command = same->advance(target * degree, rate * degree);
    ASSERT_NEAR(computer.get("reference") * degree, command.angle, 1e-13) << k;
    ASSERT_NEAR(computer.get("reference_rate") * degree, command.rate, 1e-11) << k;
  }
  EXPECT_EQ(computer.get("reference"), -14.5 + 0.01 * sample_time * 2999);
}

TEST(ControllerProgram, EncoderTurnsFollowTheWrapInBothDirections) {
  ControllerProgramOptions options = options_of();
  options.signals.encoder_zero = 0.0;
  options.signals.encoder_centre = 0.0;
  const Program program = controller_program(loops("PI"), sample_time, options);
  Interpreter computer(program);
  const auto position_at = [&](double counts) {
    computer.set("encoder_counts", counts);
    computer.step();
    return computer.get("position");
  };
  const double step = 360.0 / (1 << 20);
  computer.set("run", 1.0);
  EXPECT_DOUBLE_EQ(position_at(1048575.0), -step);
  EXPECT_DOUBLE_EQ(position_at(2.0), 2.0 * step);
  EXPECT_DOUBLE_EQ(position_at(1048570.0), -6.0 * step);
  for (double counts = 1047500.0; counts > 0.0; counts -= 1500.0) position_at(counts);
  EXPECT_DOUBLE_EQ(position_at(1048575.0), -360.0 - step);
  EXPECT_EQ(computer.get("fault"), 0.0);
}

TEST(ControllerProgram, EncoderThatJumpsIsAFaultWhileRunningAndFoundAnewInStandby) {
  const Program program = controller_program(loops("PI"), sample_time, options_of());
  Interpreter computer(program);
  computer.set("run", 1.0);
  computer.set("encoder_counts", 500000.0);
  computer.step();
  computer.step();
  const double before = computer.get("position");
  computer.set("encoder_counts", 0.0);
  computer.step();
  EXPECT_EQ(computer.get("fault"), 1.0);
  EXPECT_EQ(computer.get("valve_command"), 0.0);
  EXPECT_EQ(computer.get("position"), before);
  computer.set("encoder_counts", 500010.0);
  computer.step();
  EXPECT_EQ(computer.get("fault"), 0.0) << "the reading is back";
  computer.set("encoder_counts", 0.0);
  computer.step();
  computer.set("run", 0.0);
  computer.step();
  EXPECT_EQ(computer.get("fault"), 0.0);
  EXPECT_NEAR(computer.get("position"), -0.3 / degree, 1e-9);
}

TEST(ControllerProgram, InputsOutOfUseAreNoFault) {
  const Program program = controller_program(loops("PI"), sample_time, options_of());
  Interpreter computer(program);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  computer.set("target_angle", nan);
  computer.set("manual_command", 2.0);
  computer.step();
  EXPECT_EQ(computer.get("fault"), 0.0);
  EXPECT_EQ(computer.get("valve_command"), 2.0);
  computer.set("target_angle", 10.0);
  computer.set("manual_command", nan);
  computer.set("run", 1.0);
  computer.step();
  EXPECT_EQ(computer.get("fault"), 0.0);
  EXPECT_NEAR(computer.get("valve_command"), 2.0, 1e-9);
}

TEST(ControllerProgram, ValveClosesWhileAnInputIsNoNumberOrOutOfRange) {
  const Program program = controller_program(loops("FULL+L+C"), sample_time, options_of());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<const char*, double>> bad{{"tachometer", nan},
                                                        {"tachometer", -infinity},
                                                        {"pressure_difference", infinity},
                                                        {"target_angle", nan},
                                                        {"target_rate", infinity},
                                                        {"encoder_counts", 260000.0},
                                                        {"encoder_counts", -1.0},
                                                        {"encoder_counts", 1048576.0},
                                                        {"tachometer", 200.0},
                                                        {"pressure_difference", -30.0},
                                                        {"target_angle", 20000.0}};
  for (const auto& [name, value] : bad) {
    Interpreter computer(program);
    computer.set("run", 1.0);
    computer.set("encoder_counts", 200000.0);
    computer.set("command", 4.0);
    for (int k = 0; k < 10; ++k) computer.step();
    EXPECT_NE(computer.get("valve_command"), 0.0);
    const double good = computer.get(name);
    computer.set(name, value);
    computer.step();
    EXPECT_EQ(computer.get("fault"), 1.0) << name << " " << value;
    EXPECT_EQ(computer.get("valve_command"), 0.0) << name << " " << value;
    computer.set(name, good);
    computer.step();
    EXPECT_EQ(computer.get("fault"), 0.0) << name << " " << value;
    EXPECT_TRUE(std::isfinite(computer.get("valve_command"))) << name << " " << value;
  }
}

TEST(ControllerProgram, ValveClosesAtACommandThatIsNoNumber) {
  const Program program = controller_program(loops("PI"), sample_time, options_of());
  Interpreter computer(program);
  computer.set("run", 1.0);
  computer.step();
  computer.set("rate_integral_state1", std::numeric_limits<double>::quiet_NaN());
  computer.step();
  EXPECT_EQ(computer.get("fault"), 2.0);
  EXPECT_EQ(computer.get("valve_command"), 0.0);
  computer.step();
  EXPECT_EQ(computer.get("fault"), 0.0);
  EXPECT_TRUE(std::isfinite(computer.get("valve_command")));
}

TEST(ControllerProgram, RefusesLimitsAndScalesThatAreNotPositive) {
  const auto refused = [](auto change) {
    ControllerProgramOptions options = options_of();
    change(options);
    EXPECT_THROW(controller_program(loops("PI"), sample_time, options), InvalidInput);
  };
  refused([](auto& o) { o.command_limit = 0.0; });
  refused([](auto& o) { o.limits.rate = -1.0; });
  refused([](auto& o) { o.signals.encoder_counts = 1; });
  refused([](auto& o) { o.signals.tachometer.scale = 0.0; });
  refused([](auto& o) { o.gear_ratio = std::numeric_limits<double>::infinity(); });
}

TEST(ControllerProgram, HasNoVariableThatNothingReads) {
  const Program program = controller_program(loops("PI"), sample_time, options_of(false));
  for (const auto& variable : program.variables) {
    EXPECT_FALSE(variable.name.starts_with("friction")) << variable.name;
  }
  EXPECT_THROW(variable_index(program, "supply_torque"), InvalidInput);
}

}  // namespace
}  // namespace boresight::control::program
