#pragma once

#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::app {

/// Inputs on which a report's numbers depend but the linear plant does not.
struct NonlinearInputs {
  /// simulation.valve_stroke: what a command or a gust may ask of the valve. Always among them for
  /// a case whose goals limit gusts.
  bool valve_stroke = false;
  /// Steady motion of the nonlinear antenna (achievable rates and accelerations): valve_stroke, and
  /// of [simulation] pressures, leakage fractions, overlap, air and offset.
  bool steady_motion = false;
  /// Runs of the nonlinear antenna in time: steady_motion, and the rest of [simulation] but the
  /// rate loop of the tests; preload_torque only where there is backlash.
  bool time_runs = false;
  /// simulation.rate_loop_*, the analog rate loop of some tests of the drive.
  bool rate_loop = false;
  /// recorder.*, how tests are written down.
  bool recorder = false;
  /// computer.*, the signals of the antenna's control computer.
  bool computer = false;
};

/// Quantities of basis `assumed`, and those whose uncertainty is, in the case's order. Of
/// [simulation], [recorder] and [computer] those that `nonlinear` takes in, and those that stand in
/// for [instruments] and drive.return_pressure where a case has records and lacks them.
std::vector<io::Quantity> assumed_inputs(const io::Case& antenna,
                                         const NonlinearInputs& nonlinear = {});

/// Those of them that the identification of inertia and drive depends on: drawings, motors, oil,
/// instruments, predictions of the structure, pressures, and stated tests. Wind, loops and goals do
/// not enter.
std::vector<io::Quantity> identification_inputs(const io::Case& antenna);

/// How many of them describe the antenna, and not what is asked of it (goals, pointing).
std::size_t count_of_antenna(const std::vector<io::Quantity>& assumed);

}  // namespace boresight::app
