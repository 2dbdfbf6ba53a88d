#pragma once

#include <cstdint>
#include <string>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/controllers/command_preprocessor.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/program/program.hpp>

namespace boresight::control::program {

/// A signal of the antenna's computer: `scale` of its units per SI unit of the quantity at the
/// motor shaft.
struct SignalScale {
  double scale = 1.0;
  std::string unit;
};

/// The signals of the antenna's computer.
struct ComputerSignals {
  /// Absolute encoder of the axis: counts from 0 in one turn.
  std::int64_t encoder_counts = 0;
  double encoder_zero = 0.0;    // rad at the sky, angle at count 0
  double encoder_centre = 0.0;  // rad, middle of the travel: the turn at the start is nearest to it
  SignalScale tachometer{1.0, "rad/s"};
  SignalScale motor_torque{1.0, "N.m"};
  SignalScale valve_command{1.0, "rad/s"};
  /// Largest magnitudes that count as signals, SI at the motor; beyond them an input is a fault.
  double largest_rate = 0.0, largest_torque = 0.0;
};

struct ControllerProgramOptions {
  Feedforward feedforward = {};
  /// Largest magnitude of the valve command (rad/s). Finite.
  double command_limit = 0.0;
  CommandLimits limits = {};  // of the command preprocessor, at the sky
  double gear_ratio = 1.0;
  ComputerSignals signals = {};
};

/// The controller as it runs on the antenna's computer: AntennaController behind a
/// CommandPreprocessor, in the computer's own units, in named sections. Inputs:
///   run                  close the loop; else standby: the valve follows manual_command
///   target_angle         deg at the sky, where the axis is to be at the next sample
///   target_rate          deg/s
///   manual_command       the valve's units
///   encoder_counts       0 to one less than a turn
///   tachometer           its units
///   pressure_difference  its units, in place of the motor torque; only if the controller reads it
/// Outputs: valve_command (its units, for the next sample: the computation time of the design),
/// fault, running, position, encoder_error (deg), and the reference (deg, deg/s).
///
/// At the start, and whenever `run` comes back, the controller begins in the steady state in which
/// the valve command is what it was (AntennaController::start_from), and the reference where the
/// encoder's error of that state puts it. The reference keeps the motors' rate for one sample, so
/// that the valve does not jump, and then moves to the target within the preprocessor's limits.
///
/// `fault` is 1 for an input that is not finite or beyond its range, or an encoder that jumps while
/// running, 2 for a command that is not finite. The valve command is then 0, the safe output, and
/// the next good sample is a start. In standby an encoder may jump: its turn is found anew.
///
/// Loops are written path by path, each section in transposed direct form II (A. V. Oppenheim, R.
/// W. Schafer, Discrete-Time Signal Processing, sec. 6.3). Back calculation: their states follow
/// the angle error of which the limited command is the result (conditioned reference). State spaces
/// are written in modal blocks.
/// @throws InvalidInput as AntennaController, CommandPreprocessor, digital_sections and
/// in_modal_blocks; for a limit, scale or gear ratio that is not positive and finite, and fewer
/// than 2 encoder counts.
Program controller_program(const Controller& controller, double sample_time,
                           const ControllerProgramOptions& options);

}  // namespace boresight::control::program
