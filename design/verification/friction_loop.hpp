#pragma once

#include <boresight/design/verification/simulated_loop.hpp>

namespace boresight::design {

/// Runs a trajectory at rest on a reduced antenna, plant::FrictionTimeStepping, without wind and
/// noise. Controller, feedforward, command limit, offset torque, bristles and the steps of encoder
/// and tachometer are those of run_loop; backlash, oil lines, air and the valve's limits are
/// neglected. Some fifteen times as fast as run_loop, with steps of at most a tenth of a radian of
/// the motor's oscillation on its bristles, and an amplitude of limit cycles that is a few per cent
/// off (`./dev limit-cycles`). The result's only signal is valve_command. A loop that is lost ends
/// there; one whose controller has no steady state at rest has failed.
/// @throws InvalidInput for an interval other than the sample time or references of another length,
/// and as its parts.
LoopRun run_friction_loop(const SimulatedLoop& loop, const ReferenceTrajectory& course);

}  // namespace boresight::design
