#pragma once

#include <boresight/control/program/controller_program.hpp>
#include <boresight/control/program/test_vectors.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/verification/simulated_loop.hpp>

namespace boresight::design {

/// A controller for the antenna's computer, complete: as simulated.
struct ExportedController {
  control::Controller controller;
  double sample_time = 0.0;  // s
  control::program::ControllerProgramOptions options;
  /// The drive reaches the limits of the commanded motion that the mission asks for; else those in
  /// `options` are smaller.
  bool achievable_limits = true;
  control::CommandLimits wanted;      // rad/s, rad/s2 at the sky: what the mission asks for
  double friction_feedforward = 0.0;  // fraction of the antenna's friction in the feedforward
  control::program::Program program;
  std::vector<control::program::TestVector> vectors;
};

/// What the simulations run with the controller (make_simulated_loop): its feedforward
/// (feedforward_of), the valve's stroke as the limit of the command, and the rate and acceleration
/// limits of a slew (slew_limits). `signals`: largest rate and torque are set here, to four times
/// those of the drive.
/// @throws InvalidInput without Antenna::nonlinear, and as controller_program;
/// InfeasibleRequirement if the supply cannot move the antenna against its friction.
ExportedController exported_controller(const Mission& mission,
                                       const control::Controller& controller,
                                       const control::program::ComputerSignals& signals);

/// Limits of the commanded motion that a time-domain study applies: the mission's slew rate and 0.2
/// deg/s2, or what the drive achieves (achievable_limits) if that is less. rad/s, rad/s2 at the
/// sky.
control::CommandLimits slew_limits(const Mission& mission, const SimulatedLoop& loop);

}  // namespace boresight::design
