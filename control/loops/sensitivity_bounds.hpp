#pragma once

#include <array>

#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/controllers/control_law.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::control {

/// Plant, control law and exact dead time as modes around a core. Inputs wind_torque (N m),
/// rate_disturbance (rad/s, added to the rate command), valve_disturbance (rad/s, added to the
/// valve command behind the dead time); outputs beam, encoder (rad of motor), tachometer (rad/s),
/// motor_torque (N m), rate_command and valve_command (rad/s, disturbances included).
/// @throws InvalidInput as to_state_space of plant and law, or for a negative delay.
plant::ModalSystem modal_closed_loop(const plant::AntennaPlant& plant, const ControlLaw& law,
                                     double delay);

/// Brackets of the peak of |S| over all frequencies at the breaks of control::loop_breaks, in their
/// order: no grid, exact dead time, O(modes) an interval. A route of its own beside the frequency
/// responses that loops are tuned on: poles and residues of the state space of drive and law, modes
/// in angles relative to the bull gear. At least 1: S tends to 1 at infinite frequency.
std::array<PeakGain, 3> sensitivity_bounds(const plant::AntennaPlant& plant, const ControlLaw& law,
                                           double delay, const PeakGainOptions& options = {});

}  // namespace boresight::control
