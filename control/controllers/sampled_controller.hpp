#pragma once

#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// The controller with every corner (lag, lead, washout, notch) prewarped, so that Tustin's method
/// restores it: w' = (2/T) tan(w T/2). Corners up to half the Nyquist frequency pi/T, notches up to
/// 0.9 of it, are mapped exactly. With l that limit, corners beyond it are moved in proportion, w'
/// = w tan(l T/2)/(l T/2). The sampled response at l then equals the continuous one, and the block
/// keeps its phase below l even if its own corner cannot be represented. Corners of integrals are
/// not prewarped (trapezoidal rule).
/// @throws InvalidInput as control::validate, or unless sample_time is positive and finite (s).
Controller prewarped(const Controller& controller, double sample_time);

/// The sampled form of a controller. Each block is discretised by Tustin's method with s = (2/T)(z
/// - 1)/(z + 1) from its prewarped corner (G. F. Franklin, J. D. Powell, M. Workman, Digital
/// Control of Dynamic Systems, 3rd ed., 6.1). Integrals use the trapezoidal rule; each lead is
/// combined with its own lag. The left half plane maps into the unit circle, so every block is
/// stable for any corner, also beyond the Nyquist frequency. Hold and dead time are not included;
/// they belong to the loop. Inputs: tachometer (rad/s), encoder, angle_reference (rad; subtracted
/// from the encoder), rate_disturbance (rad/s, added to the rate command), motor_torque (N m, only
/// if the controller feeds it back). Outputs: valve_demand, rate_command (rad/s). States as
/// to_state_space. A state space is sampled already: as it is, with_rate_command.
/// @throws InvalidInput as prewarped, and for a state space with another sample time.
plant::StateSpace sampled_controller(const Controller& controller, double sample_time);

/// The same with the position loop open: inputs and output of rate_loop_controller.
plant::StateSpace sampled_rate_loop_controller(const Controller& controller, double sample_time);

/// The controller in its sampled form in a loop with a continuous plant. The plant has the input
/// valve_command and the outputs tachometer, encoder and, if the controller feeds it back,
/// motor_torque. The loop contains a zero-order hold and one sample of computation delay.
/// References are external inputs.
/// @throws InvalidInput as prewarped.
SampledLoop sampled_loop(const plant::StateSpace& plant, const Controller& controller,
                         double sample_time);

/// The same with the position loop open. The free angle of an antenna is then not controlled: an
/// eigenvalue of 1 remains in the closed loop.
SampledLoop sampled_rate_loop(const plant::StateSpace& plant, const Controller& controller,
                              double sample_time);

}  // namespace boresight::control
