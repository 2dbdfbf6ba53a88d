#include <algorithm>
#include <cmath>
#include <numbers>

#include <boresight/control/program/program_controller.hpp>

namespace boresight::control::program {

ProgramController::ProgramController(const Controller& controller, double sample_time,
                                     const ControllerProgramOptions& options,
                                     const MakeRunner& runner)
    : options_(options),
      program_(controller_program(controller, sample_time, options)),
      runner_(runner ? runner(program_) : std::make_unique<Interpreter>(program_)),
      counts_(variable_index(program_, "encoder_counts")),
      tachometer_(variable_index(program_, "tachometer")),
      target_angle_(variable_index(program_, "target_angle")),
      target_rate_(variable_index(program_, "target_rate")),
      command_(variable_index(program_, "valve_command")),
      error_(variable_index(program_, "encoder_error")),
      reads_torque_(controller.structure.feeds_torque_back()),
      inputs_{"tachometer", "encoder"},
      outputs_{"valve_command"} {
  if (reads_torque_) {
    torque_ = variable_index(program_, "pressure_difference");
    inputs_.emplace_back("motor_torque");
  }
  for (const char* reference : {"reference", "reference_rate", "reference_acceleration"}) {
    inputs_.emplace_back(reference);
  }
  restart();
}

// Angles and rates in rad of motor.
void ProgramController::step(Runner& runner, double tachometer, double encoder, double torque,
                             double target, double target_rate) const {
  const ComputerSignals& signals = options_.signals;
  const double degrees = 180.0 / (std::numbers::pi * options_.gear_ratio);
  const auto counts = static_cast<double>(signals.encoder_counts);
  const double zero = signals.encoder_zero * 180.0 / std::numbers::pi;
  const double turns = (encoder * degrees - zero) / 360.0;
  runner.set("run", 1.0);
  const double in_turn = (turns - std::floor(turns)) * counts;
  runner.set_value(counts_, std::min(in_turn, std::nextafter(counts, 0.0)));
  runner.set_value(tachometer_, tachometer * signals.tachometer.scale);
  if (reads_torque_) runner.set_value(torque_, torque * signals.motor_torque.scale);
  runner.set_value(target_angle_, target * degrees);
  runner.set_value(target_rate_, target_rate * degrees);
  runner.step();
}

// Before the sample at which the steady motion is at this reference (rad of motor). The encoder's
// counts of then are no whole ones, which compiled code cannot take.
Interpreter ProgramController::started_at(double reference) const {
  Interpreter starter(program_);
  starter.set("command", motion_.valve_command);
  const double rate = motion_.tachometer;
  step(starter, rate, reference + lead_ - rate * program_.sample_time, motion_.motor_torque,
       reference, rate);
  return starter;
}

void ProgramController::restart() {
  runner_->restart();
  waits_ = true;
}

double ProgramController::start_from(const SteadyMotion& motion) {
  motion_ = motion;
  lead_ = 0.0;
  const double centre = options_.signals.encoder_centre * options_.gear_ratio;
  lead_ = started_at(centre).value(error_) * std::numbers::pi / 180.0 * options_.gear_ratio;
  restart();
  return lead_;
}

void ProgramController::update(double /*time*/, const Eigen::Ref<const Eigen::VectorXd>& measured,
                               Eigen::Ref<Eigen::VectorXd> commands) {
  const Eigen::Index first = reads_torque_ ? 3 : 2;
  const double t = program_.sample_time;
  const double reference = measured[first], rate = measured[first + 1];
  const double acceleration = measured[first + 2];
  if (waits_) {
    const Interpreter starter = started_at(reference);
    for (std::size_t i = 0; i < program_.variables.size(); ++i) {
      if (program_.variables[i].role == Role::state) runner_->set_value(i, starter.value(i));
    }
    waits_ = false;
  }
  step(*runner_, measured[0], measured[1], reads_torque_ ? measured[2] : 0.0,
       reference + t * (rate + 0.5 * t * acceleration), rate + t * acceleration);
  commands[0] = runner_->value(command_) / options_.signals.valve_command.scale;
}

}  // namespace boresight::control::program
