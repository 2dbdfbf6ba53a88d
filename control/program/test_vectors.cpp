#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <boresight/control/program/interpreter.hpp>
#include <boresight/control/program/test_vectors.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::control::program {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double agreement = 1e-12;

// One scenario of the axis: what its operator and its surroundings do at a sample.
struct Scenario {
  const char* name;
  const char* description;
  double start = 0.0;  // rad at the sky
  /// Target (deg, deg/s) at sample k + 1, from the start (deg).
  std::function<CommandSample(int)> target;
  std::function<double(int)> gust = nullptr;  // rad at the sky by which the axis jumps
  /// Changes of the inputs.
  std::function<void(int, Interpreter&)> operate = nullptr;
};

// A rigid axis on the oil spring behind a lagging valve; of the antenna as far as the feedforward
// tells.
class Axis {
 public:
  Axis(const ControllerProgramOptions& options, double start, std::uint64_t seed)
      : options_(options), angle_(start), random_(seed, 1) {
    const Feedforward& forward = options.feedforward;
    if (forward.friction_change_to_valve_command > 0.0) {
      stiffness_ = 1.0 / forward.friction_change_to_valve_command;
      leakage_ = forward.friction_to_valve_command * stiffness_;
    } else {
      stiffness_ = options.signals.largest_torque / options.command_limit;
    }
    constexpr double usual_mode = 6.0;  // rad/s
    inertia_ = forward.acceleration_to_motor_torque > 0.0 ? forward.acceleration_to_motor_torque
                                                          : stiffness_ / (usual_mode * usual_mode);
  }

  void sense(int k, bool torque, Interpreter& computer) const {
    const ComputerSignals& signals = options_.signals;
    const auto turn = static_cast<double>(signals.encoder_counts);
    const double all =
        std::round((angle_ - signals.encoder_zero) * turn / (2.0 * std::numbers::pi));
    const auto noise = random_.pair(static_cast<std::uint64_t>(k));
    computer.set("encoder_counts", all - turn * std::floor(all / turn));
    computer.set("tachometer",
                 (rate_ + 1e-4 * options_.command_limit * noise.real()) * signals.tachometer.scale);
    if (torque) {
      computer.set("pressure_difference", (torque_ + 1e-3 * signals.largest_torque * noise.imag()) *
                                              signals.motor_torque.scale);
    }
  }

  // The valve command of a sample acts from the next one on.
  void move(double valve, double sample_time, double gust) {
    constexpr double lag = 0.6;
    spool_ += lag * (waiting_ - spool_);
    torque_ += sample_time * (stiffness_ * (spool_ - rate_) - leakage_ * torque_);
    const double supply = 0.25 * options_.signals.largest_torque;
    torque_ = std::clamp(torque_, -supply, supply);
    rate_ += sample_time * torque_ / inertia_;
    angle_ += sample_time * rate_ / options_.gear_ratio + gust;
    waiting_ = valve;
  }

 private:
  const ControllerProgramOptions& options_;
  double stiffness_ = 1.0, leakage_ = 1.0, inertia_ = 1.0;
  double angle_, rate_ = 0.0, torque_ = 0.0, spool_ = 0.0, waiting_ = 0.0;
  numerics::NormalNumbers random_;
};

std::vector<std::size_t> variables_of(const Program& program, Role role) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < program.variables.size(); ++i) {
    if (program.variables[i].role == role) found.push_back(i);
  }
  return found;
}

std::vector<double> values_of(const Interpreter& computer,
                              const std::vector<std::size_t>& variables) {
  std::vector<double> values;
  for (const std::size_t i : variables) values.push_back(computer.value(i));
  return values;
}

void find_tolerances(const Program& program, const std::vector<std::size_t>& inputs,
                     const std::vector<std::size_t>& outputs, TestVector& vector) {
  Interpreter single(program, Precision::single_precision);
  std::vector<double> largest(outputs.size(), 1.0);
  vector.single_tolerance.assign(outputs.size(), 0.0);
  for (std::size_t k = 0; k < vector.inputs.size(); ++k) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      single.set_value(inputs[i], vector.inputs[k][i]);
    }
    single.step();
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const double expected = vector.outputs[k][i];
      largest[i] = std::max(largest[i], std::abs(expected));
      vector.single_tolerance[i] =
          std::max(vector.single_tolerance[i], std::abs(single.value(outputs[i]) - expected));
    }
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    vector.double_tolerance.push_back(agreement * largest[i]);
    vector.single_tolerance[i] =
        single_margin * vector.single_tolerance[i] + vector.double_tolerance[i];
  }
}

TestVector run(const Program& program, const ControllerProgramOptions& options,
               const Scenario& scenario, std::uint64_t seed) {
  const auto inputs = variables_of(program, Role::input);
  const auto outputs = variables_of(program, Role::output);
  const bool torque = std::ranges::find(program.variables, "pressure_difference",
                                        &Variable::name) != program.variables.end();
  TestVector vector;
  vector.name = scenario.name;
  vector.description = scenario.description;
  Interpreter computer(program);
  Axis axis(options, scenario.start, seed);
  constexpr int first_run = 10;
  for (int k = 0; k < test_vector_samples; ++k) {
    const CommandSample target = scenario.target(k);
    computer.set("run", k < first_run ? 0.0 : 1.0);
    computer.set("manual_command", 0.0);
    computer.set("target_angle", scenario.start / degree + target.angle);
    computer.set("target_rate", target.rate);
    axis.sense(k, torque, computer);
    if (scenario.operate) scenario.operate(k, computer);
    vector.inputs.push_back(values_of(computer, inputs));
    computer.step();
    vector.outputs.push_back(values_of(computer, outputs));
    axis.move(computer.get("valve_command") / options.signals.valve_command.scale,
              program.sample_time, scenario.gust ? scenario.gust(k) : 0.0);
  }
  find_tolerances(program, inputs, outputs, vector);
  return vector;
}

CommandSample chirp(double time) {
  constexpr double amplitude = 0.002;              // deg
  constexpr double first = 0.1, per_second = 0.2;  // Hz, Hz/s
  const double phase = 2.0 * std::numbers::pi * (first + 0.5 * per_second * time) * time;
  const double frequency = 2.0 * std::numbers::pi * (first + per_second * time);
  return {amplitude * std::sin(phase), amplitude * frequency * std::cos(phase), 0.0};
}

}  // namespace

std::vector<TestVector> test_vectors(const Program& program,
                                     const ControllerProgramOptions& options) {
  const double t = program.sample_time;
  const double centre = options.signals.encoder_centre;
  const double step = 2.0 * std::numbers::pi / static_cast<double>(options.signals.encoder_counts);
  // The zero of the encoder that is nearest to the middle of the travel; of two the lower one.
  const double turns = (centre - options.signals.encoder_zero) / (2.0 * std::numbers::pi);
  const double zero =
      options.signals.encoder_zero + 2.0 * std::numbers::pi * std::ceil(turns - 0.5);
  // Reversed within a second, deg/s.
  constexpr double reversal = 20.0;  // samples to stop in
  const double fast =
      std::min(0.8 * options.limits.rate, reversal * t * options.limits.acceleration) / degree;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Scenario> scenarios{
      {.name = "steps",
       .description = "steps of the target by 5 mdeg and back",
       .start = centre,
       .target =
           [](int k) {
             return CommandSample{k < 50 || k >= 250 ? 0.0 : 0.005, 0.0, 0.0};
           }},
      {.name = "chirp",
       .description = "a target that swings 2 mdeg at 0.1 to 2 Hz",
       .start = centre,
       .target = [t](int k) { return chirp(t * (k + 1)); }},
      {.name = "saturation",
       .description = "the axis blown away by 1.4 deg, the valve at its limit, and recovery",
       .start = centre,
       .target = [](int) { return CommandSample{}; },
       .gust = [](int k) { return k >= 100 && k < 120 ? 0.07 * degree : 0.0; }},
      {.name = "wrap",
       .description = "across the encoder's wrap and back",
       .start = zero + 20.0 * step,
       .target =
           [t, fast](int k) {
             constexpr int turn = 2 * test_vector_samples / 5;
             return CommandSample{-fast * t * std::min(k + 1, 2 * turn - k - 1),
                                  k + 1 < turn ? -fast : fast, 0.0};
           }},
      {.name = "modes",
       .description = "standby with a manual command, back to the loop, and inputs that are bad",
       .start = centre,
       .target =
           [](int) {
             return CommandSample{0.02, 0.0, 0.0};
           },
       .operate =
           [&options, nan, infinity](int k, Interpreter& computer) {
             const double full = options.command_limit * options.signals.valve_command.scale;
             if (k >= 100 && k < 160) {
               computer.set("run", 0.0);
               computer.set("manual_command", k < 130 ? 0.01 * full : 2.0 * full);
             }
             if (k == 250) computer.set("tachometer", nan);
             if (k == 251) computer.set("target_angle", infinity);
             if (k == 252) {
               computer.set("encoder_counts", static_cast<double>(options.signals.encoder_counts));
             }
             if (k == 140) computer.set("manual_command", -infinity);
             if (k == 301) computer.set("target_rate", nan);
             if (k == 302) computer.set("encoder_counts", -1.0);
           }}};
  std::vector<TestVector> vectors;
  std::uint64_t seed = 1;
  for (const Scenario& scenario : scenarios) {
    vectors.push_back(run(program, options, scenario, seed++));
  }
  return vectors;
}

}  // namespace boresight::control::program
