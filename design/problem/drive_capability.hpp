#pragma once

#include <boresight/control/controllers/command_preprocessor.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

namespace boresight::design {

/// Acceleration (rad/s2 at the sky) of a commanded slew, where the drive achieves it.
inline constexpr double slew_acceleration = 0.2 * degree;

/// The highest rate up to `wanted` (rad/s of motor) that the supply sustains against friction and
/// offset in both directions, to 1e-6 of `wanted`; 0 if none.
double attainable_rate(const plant::NonlinearAntenna& antenna, double wanted);

/// Achievable rate and acceleration (rad/s, rad/s2 of motor) with a reserve for the drive. The rate
/// is the wanted one or, if the supply cannot sustain it, four fifths of the attainable rate. The
/// acceleration is the wanted one or, if less, half of what the remaining torque at that rate gives
/// the inertia. `inertia`: of the whole antenna, kg m2. A rate or acceleration of 0 or less means
/// that the supply cannot move the antenna against its friction.
control::CommandLimits achievable_limits(const plant::NonlinearAntenna& antenna, double inertia,
                                         const control::CommandLimits& wanted);

}  // namespace boresight::design
