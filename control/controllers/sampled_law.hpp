#pragma once

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// The law with every corner (of lag, lead, washout, notch) placed so that Tustin's method puts it
/// back where it was: w' = (2/T) tan(w T/2). A corner is placed exactly up to half the Nyquist
/// frequency pi/T, a notch up to 0.9 of it; what lies beyond is moved in proportion, w' = w tan(l
/// T/2)/(l T/2) with l that limit: then the response is the continuous one at l, and a block keeps
/// its phase below where its own corner cannot be told any more. Corners of integrals stay: the
/// trapezoidal rule.
/// @throws InvalidInput as validate(law), or unless sample_time is positive and finite (s).
ControlLaw prewarped(const ControlLaw& law, double sample_time);

/// The sampled form of a law, block by block: each by Tustin's method with s = (2/T)(z - 1)/(z + 1)
/// from its prewarped corner (G. F. Franklin, J. D. Powell, M. Workman, Digital Control of Dynamic
/// Systems, 3rd ed., 6.1), integrals by the trapezoidal rule, each lead on a lag of its own. Since
/// the left half plane maps into the unit circle, every block is stable whatever its corner, beyond
/// the Nyquist frequency as well. Neither hold nor dead time are in it: those are the loop's.
/// Inputs tachometer (rad/s), encoder, angle_reference (rad; the encoder is taken against it),
/// rate_disturbance (rad/s, added to the rate command), motor_torque (N m, only if the law feeds it
/// back); outputs valve_demand, rate_command (rad/s). States as to_state_space(law).
/// @throws InvalidInput as prewarped.
plant::StateSpace sampled_law(const ControlLaw& law, double sample_time);

/// The same with the position loop open: inputs and output of rate_loop_law.
plant::StateSpace sampled_rate_loop_law(const ControlLaw& law, double sample_time);

/// The law in its sampled form around a continuous plant with the input valve_command and the
/// outputs tachometer, encoder and, where the law feeds it back, motor_torque: zero-order hold and
/// one sample of computation delay, nothing else. References come from outside.
/// @throws InvalidInput as prewarped.
SampledLoop sampled_loop(const plant::StateSpace& plant, const ControlLaw& law, double sample_time);

/// The same with the position loop open. The free angle of an antenna is not controlled then: an
/// eigenvalue of 1 remains in the closed loop.
SampledLoop sampled_rate_loop(const plant::StateSpace& plant, const ControlLaw& law,
                              double sample_time);

}  // namespace boresight::control
