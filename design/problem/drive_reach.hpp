#pragma once

#include <boresight/control/controllers/command_preprocessor.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

namespace boresight::design {

/// The highest rate up to `wanted` (rad/s of motor) that the supply holds against friction and
/// offset both ways, to 1e-6 of it; 0 if none.
double attainable_rate(const plant::NonlinearAntenna& antenna, double wanted);

/// Rate and acceleration (rad/s, rad/s2 of motor) that leave the drive a reserve: the wanted ones,
/// or four fifths of the rate that the supply can hold if that is less, and half of what the torque
/// left at that rate gives the whole antenna, of `inertia` kg m2, if that is less. A rate
/// or acceleration of 0 or less: the supply cannot move the antenna against its friction.
control::CommandLimits within_reach(const plant::NonlinearAntenna& antenna, double inertia,
                                    const control::CommandLimits& wanted);

}  // namespace boresight::design
