#pragma once

#include <boresight/control/controllers/controller.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// The rate loop with its command as input, position loop open. Inputs: command (rad/s) and
/// wind_torque (N m). Outputs: tachometer (rad/s), motor_torque (N m) and valve_demand (rad/s), all
/// at the motor shaft. Dead time as in closed_loop. `plant`: of to_state_space, or the same as
/// other sensors show it.
/// @throws InvalidInput as connect, and as to_state_space of the controller.
plant::StateSpace rate_command_loop(const plant::StateSpace& plant, const Controller& controller,
                                    double delay);

/// Both loops with position command and feedforward signals as inputs. Inputs: command (rad),
/// rate_disturbance (rad/s, subtracted from the tachometer, which adds it to the rate command of
/// loops), valve_feedforward (rad/s, added to the valve demand), wind_torque (N m) and, of a state
/// space that reads it, torque_feedforward (N m, subtracted from the motor torque). Outputs:
/// encoder (rad), motor_torque (N m) and whole_demand (rad/s, feedforward included), all at the
/// motor shaft. Dead time and `plant` as above.
/// @throws InvalidInput as connect, and as to_state_space of the controller.
plant::StateSpace position_command_loop(const plant::StateSpace& plant,
                                        const Controller& controller, double delay);

}  // namespace boresight::control
