#pragma once

#include <array>

#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::control {

/// Plant, controller and exact dead time as modes around a core. Inputs: wind_torque (N m),
/// rate_disturbance (rad/s, added to the rate command), valve_disturbance (rad/s, added to the
/// valve command after the dead time). Outputs: boresight (`boresight`) and encoder (rad of motor),
/// tachometer (rad/s), motor_torque (N m), rate_command and valve_command (rad/s, disturbances
/// included).
/// @throws InvalidInput as to_state_space of plant and controller, or for a negative delay.
plant::ModalSystem modal_closed_loop(const plant::AntennaPlant& plant, const Controller& controller,
                                     double delay);

/// Bounds of Ms, the maximum of |S| over all frequencies, at the breaks of control::loop_breaks, in
/// their order. No grid, exact dead time, O(modes) per interval. The method is independent of the
/// frequency responses used in tuning: it uses poles and residues of the state space of drive and
/// controller, and modes in angles relative to the bull gear. The result is at least 1, because S
/// tends to 1 at infinite frequency. A state space has the valve command alone to break: from the
/// exact sampled loop, up to its Nyquist frequency; 1 stands at the others.
std::array<PeakGain, 3> sensitivity_bounds(const plant::AntennaPlant& plant,
                                           const Controller& controller, double delay,
                                           const PeakGainOptions& options = {});

}  // namespace boresight::control
