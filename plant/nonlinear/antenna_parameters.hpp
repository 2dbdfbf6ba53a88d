#pragma once

#include <string_view>
#include <vector>

#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

namespace boresight::plant {

/// Numbers of a nonlinear antenna that records are fitted by.
enum class AntennaParameter {
  motor_inertia,      // kg m2
  antenna_inertia,    // kg m2: all of the structure in proportion, its springs kept
  bulk_modulus,       // relative to that of the antenna given: both sides, slosh frequencies
  leakage,            // relative to that of the antenna given: every conductance
  supply_torque,      // N m
  coulomb_torque,     // N m, this and the next as FrictionCurve
  breakaway_torque,   // N m
  stribeck_rate,      // rad/s
  saturating_torque,  // N m
  saturating_rate,    // rad/s
  viscous_friction,   // N m s/rad, of the curve
  bristle_stiffness,  // N m/rad
  bristle_damping,    // N m s/rad
  offset_torque,      // N m, the constant part
  gear_stiffness,     // N m/rad
  valve_corner,       // rad/s
};
std::string_view to_string(AntennaParameter parameter);
const std::vector<AntennaParameter>& antenna_parameters();

/// Its value; 1 for the relative ones.
double parameter(const NonlinearAntenna& antenna, AntennaParameter which);

/// The antenna with another value of one parameter, everything else unchanged.
/// @throws InvalidInput for a value that is not finite, or not above 0 where the parameter must be.
NonlinearAntenna with_parameter(NonlinearAntenna antenna, AntennaParameter which, double value);

}  // namespace boresight::plant
