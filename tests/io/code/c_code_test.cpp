#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scratch_folder.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/lqg/lqg.hpp>
#include <boresight/control/program/program_controller.hpp>
#include <boresight/design/studies/export_study.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/code/c_code.hpp>
#include <boresight/io/code/computer_signals.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::io {
namespace {

namespace program = control::program;
using control::program::Precision;
using control::program::Program;
using control::program::Role;
using control::program::Type;

// All variables but locals between a program's struct and an array of doubles.
std::string shim(const Program& program) {
  std::string to_struct, from_struct;
  std::size_t index = 0;
  for (const auto& variable : program.variables) {
    const std::size_t at = index++;
    if (variable.role == Role::local) continue;
    const char* owner = variable.role == Role::parameter ? "parameters"
                        : variable.role == Role::input   ? "inputs"
                        : variable.role == Role::output  ? "outputs"
                                                         : "state";
    const std::string value =
        variable.type == Type::boolean   ? fmt::format("values[{}] > 0.5", at)
        : variable.type == Type::integer ? fmt::format("(int32_t)lround(values[{}])", at)
        : variable.type == Type::real    ? fmt::format("(servo_real)values[{}]", at)
                                         : fmt::format("values[{}]", at);
    to_struct += fmt::format("  {}.{} = {};\n", owner, variable.name, value);
    from_struct += fmt::format("  values[{}] = (double){}.{};\n", at, owner, variable.name);
  }
  return fmt::format(R"(#include "servo_controller.h"
#include <math.h>
static servo_parameters parameters;
static servo_state state;
static servo_inputs inputs;
static servo_outputs outputs;
void shim_restart(double *values)
{{
  servo_initialise(&state);
  parameters = servo_default_parameters;
{0}}}
void shim_step(double *values)
{{
{1}  servo_step(&parameters, &state, &inputs, &outputs);
{0}}}
)",
                     from_struct, to_struct);
}

// The generated C as a library of its own.
class CompiledProgram final : public program::Runner {
 public:
  CompiledProgram(const Program& program, Precision precision)
      : Runner(program), values_(program.variables.size(), 0.0) {
    for (const auto& file : c_code(program, precision)) folder_.write(file.name, file.content);
    const std::string code = folder_.file("servo_controller.c");
    const std::string library = folder_.file("library.so");
    const std::string command = fmt::format(
        "cc -std=c99 -pedantic -Wall -Wextra -Wconversion -Werror -O2 -ffp-contract=off -shared "
        "-fPIC -o {} {} {} -lm",
        library, code, folder_.write("shim.c", shim(program)));
    if (std::system(command.c_str()) != 0) throw std::runtime_error("the code does not compile");
    library_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) throw std::runtime_error(dlerror());
    restart_ = reinterpret_cast<Function>(dlsym(library_, "shim_restart"));
    step_ = reinterpret_cast<Function>(dlsym(library_, "shim_step"));
    CompiledProgram::restart();
  }
  CompiledProgram(const CompiledProgram&) = delete;
  CompiledProgram& operator=(const CompiledProgram&) = delete;
  ~CompiledProgram() override { dlclose(library_); }

  void restart() override { restart_(values_.data()); }
  void step() override { step_(values_.data()); }
  double value(std::size_t variable) const override { return values_[variable]; }
  void set_value(std::size_t variable, double value) override { values_[variable] = value; }

 private:
  using Function = void (*)(double*);
  ScratchFolder folder_;
  std::vector<double> values_;
  void* library_ = nullptr;
  Function restart_ = nullptr, step_ = nullptr;
};

struct Antenna {
  Case stated = read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/case.toml");
  design::Mission mission = mission_of(stated);
  CaseSignals signals = computer_signals(stated, mission);
};

const Antenna& antenna() {
  static const Antenna antenna;
  return antenna;
}

// Cautious on the 70-m antenna, with every block of the structure.
control::Controller loops(const std::string& name) {
  control::Controller controller{control::LoopStructure::named(name), {}};
  const std::map<std::string, double> gains{
      {"kr", 0.8},  {"wi", 0.3},   {"wz", 7.0},  {"wp", 40.0},  {"kT", 0.1},   {"wd", 30.0},
      {"kp", 0.4},  {"wip", 0.05}, {"wpp", 1.0}, {"wzp", 10.0}, {"cs", 0.004}, {"wcs", 0.3},
      {"wn", 12.0}, {"zz", 0.2},   {"zp", 0.7},  {"dzp", 0.03}, {"fzp", 0.1}};
  for (const auto& gain : controller.structure.gains()) {
    controller.gains.push_back(gains.at(gain.symbol));
  }
  return controller;
}

// The same controller as a state space.
control::Controller state_space(const std::string& name) {
  const double sample_time = 0.02;
  const auto sampled = control::sampled_controller(loops(name), sample_time);
  const auto system =
      plant::subsystem(sampled, {"tachometer", "encoder", "motor_torque"}, {"valve_demand"});
  return control::state_space_controller("of loops", system);
}

// Optimal for wind torque as white noise, on the linear antenna.
control::Controller lqg() {
  const design::TrackingProblem problem = design::tracking_problem(antenna().mission);
  control::LqgProblem lqg;
  lqg.plant = plant::to_state_space(problem.plant);
  lqg.commands = {"valve_command"};
  lqg.measured = {"tachometer", "encoder", "motor_torque"};
  lqg.sample_time = lqg.computation_delay = 0.02;
  lqg.disturbance_intensity = {{"wind_torque", 10.0}, {"valve_command", 0.01}};
  lqg.measurement_variance = {{"tachometer", 4e-4}, {"encoder", 1e-3}, {"motor_torque", 0.25}};
  lqg.output_weight = {{"beam", 1.0}};
  lqg.command_weight = {{"valve_command", 0.02}};
  auto controller = control::lqg(lqg).controller;
  controller.outputs = {"valve_demand"};
  return control::state_space_controller("LQG", controller);
}

// The compiled controller moves the antenna; the simulated one reads the same sensors beside it.
class Beside final : public control::StartedController {
 public:
  Beside(control::StartedController& compiled, control::StartedController& simulated)
      : compiled_(compiled), simulated_(simulated) {}
  double sample_time() const override { return compiled_.sample_time(); }
  const std::vector<std::string>& inputs() const override { return compiled_.inputs(); }
  const std::vector<std::string>& outputs() const override { return compiled_.outputs(); }
  void restart() override {
    compiled_.restart();
    simulated_.restart();
  }
  double start_from(const control::SteadyMotion& motion) override {
    const double lead = compiled_.start_from(motion);
    EXPECT_NEAR(simulated_.start_from(motion), lead, 1e-9 * std::max(1.0, std::abs(lead)));
    return lead;
  }
  void update(double time, const Eigen::Ref<const Eigen::VectorXd>& measured,
              Eigen::Ref<Eigen::VectorXd> commands) override {
    Eigen::VectorXd beside(1);
    simulated_.update(time, measured, beside);
    compiled_.update(time, measured, commands);
    difference_ = std::max(difference_, std::abs(beside[0] - commands[0]));
    largest_ = std::max(largest_, std::abs(commands[0]));
  }
  double difference() const { return difference_; }
  double largest() const { return largest_; }

 private:
  control::StartedController& compiled_;
  control::StartedController& simulated_;
  double difference_ = 0.0, largest_ = 0.0;
};

// Through a velocity reversal and wind, with noise.
design::ReferenceTrajectory course(const design::SimulatedLoop& loop,
                                   const control::CommandLimits& limits, double duration) {
  const double gear = loop.gear_ratio;
  auto made = design::shaped_course(
      {limits.rate * gear, limits.acceleration * gear}, loop.sample_time,
      design::whole_samples(duration, loop.sample_time), 4, [&](double time) {
        const double rate = 7e-5 * gear;
        return time < 0.5 * duration
                   ? control::CommandSample{rate * time, rate, 0.0}
                   : control::CommandSample{rate * (duration - time) + 1e-4 * gear, -rate, 0.0};
      });
  for (Eigen::Index k = 0; k < made.wind_torque.size(); ++k) {
    made.wind_torque[k] = 4.0 + 3.0 * std::sin(0.4 * made.interval * static_cast<double>(k));
  }
  return made;
}

struct Runs {
  design::LoopRun own, compiled;
  double difference = 0.0;  // rad/s of valve command, on the same measurements
};

Runs run_both(const control::Controller& controller, Precision precision) {
  const auto& [stated, mission, signals] = antenna();
  const auto exported = design::exported_controller(mission, controller, signals.signals);
  auto loop = design::make_simulated_loop(design::tracking_problem(mission),
                                          plant::nonlinear_antenna(mission.antenna), controller);
  loop.encoder_resolution = 2.0 * std::numbers::pi * loop.gear_ratio /
                            static_cast<double>(signals.signals.encoder_counts);
  // A whole number of counts from the simulated angle, which is about 0.
  auto options = exported.options;
  options.signals.encoder_zero = -0.25 * std::numbers::pi;
  options.signals.encoder_centre = 0.0;
  program::ProgramController compiled(
      controller, loop.sample_time, options, [&](const Program& program) {
        return std::make_unique<CompiledProgram>(program, precision);
      });
  control::AntennaController simulated(
      controller, loop.sample_time,
      {.feedforward = options.feedforward, .command_limit = options.command_limit});
  Beside beside(compiled, simulated);
  const auto trajectory = course(loop, options.limits, 30.0);
  design::LoopRunOptions run;
  Runs runs;
  runs.own = design::run_loop(loop, trajectory, run);
  run.controller = &beside;
  runs.compiled = design::run_loop(loop, trajectory, run);
  runs.difference = beside.difference();
  EXPECT_EQ(runs.own.status, design::RunStatus::complete) << runs.own.message;
  EXPECT_EQ(runs.compiled.status, design::RunStatus::complete) << runs.compiled.message;
  EXPECT_GT(beside.largest(), 1.0) << "rad/s";
  return runs;
}

control::Controller controller_named(const std::string& name) {
  if (name == "SS") return state_space("FULL+L+C");
  return name == "LQG" ? lqg() : loops(name);
}

class OfStructure : public testing::TestWithParam<std::string> {};

// Rounding of encoder steps makes two runs part in the end, so that the last digits of commands are
// compared on the same measurements.
TEST_P(OfStructure, CompiledCodeMovesTheAntennaAsTheSimulatedController) {
  const Runs runs = run_both(controller_named(GetParam()), Precision::double_precision);
  EXPECT_LT(runs.difference, 1e-12 * antenna().stated.simulation->valve_stroke.value);
  // For two seconds, of a turn of the axis.
  constexpr Eigen::Index steps = 400;
  EXPECT_LT(
      (runs.own.boresight_error - runs.compiled.boresight_error).head(steps).cwiseAbs().maxCoeff(),
      1e-12 * 2.0 * std::numbers::pi);
}

TEST_P(OfStructure, SinglePrecisionKeepsThePointingError) {
  const Runs runs = run_both(controller_named(GetParam()), Precision::single_precision);
  const auto rms = [](const Eigen::VectorXd& error) {
    return std::sqrt((error.array() - error.mean()).square().mean());
  };
  const double own = rms(runs.own.boresight_error);
  EXPECT_NEAR(rms(runs.compiled.boresight_error), own, 0.01 * own);
  EXPECT_LT(runs.difference, 1e-5 * antenna().stated.simulation->valve_stroke.value);
}

INSTANTIATE_TEST_SUITE_P(CCode, OfStructure,
                         testing::Values("PI-0", "PI", "DPF", "LL", "FULL", "LL+L", "FULL+N",
                                         "FULL+L+C", "FULL+D", "LL+L+F", "FULL+L+D+C", "SS", "LQG"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::erase_if(name, [](char c) { return c == '+' || c == '-'; });
                           return name;
                         });

}  // namespace
}  // namespace boresight::io
