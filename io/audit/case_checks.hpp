#pragma once

#include <string>

#include <boresight/io/audit/physical_checks.hpp>
#include <boresight/io/units/quantity.hpp>

/// The checks of check_physics, one by one: each appends what came of it to `found`, and reads what
/// else is there.
namespace boresight::io {

/// Appends a check without numbers, good until the next one is.
design::PhysicalCheck& begin_check(PhysicalChecks& found, std::string id, std::string quantity,
                                   bool holds = true);
/// A quantity of the case as an entry of a check.
design::CheckedEntry entry_of(const Quantity& quantity);

/// Torque of all motors (N m), with its standard uncertainty.
struct MotorTorque {
  double value = 0.0;
  double uncertainty = 0.0;
};
/// At the supply pressure, the return pressure not taken off.
MotorTorque torque_of_supply(const Case& antenna, const ShaftNumbers& shaft);
/// By the friction curve, to first order.
MotorTorque friction_at_slew_rate(const Case& antenna, const ShaftNumbers& shaft);
/// Whether that is more than the supply's torque, by more than two standard uncertainties.
bool friction_stops_slewing(const Case& antenna, const ShaftNumbers& shaft);

/// Rate of the motors (rad/s) for a volt of the tachometer.
double motor_rate_per_volt(const TachometerEntry& tachometer);

void check_inertia_remainders(const Case& antenna, PhysicalChecks& found);
void check_expected_resonance(const Case& antenna, PhysicalChecks& found);
void check_resonance_damping(const Case& antenna, PhysicalChecks& found);
void check_coincidences(const Case& antenna, PhysicalChecks& found);
void check_structural_bound(const Case& antenna, PhysicalChecks& found);
void check_wave_speeds(const Case& antenna, PhysicalChecks& found);
void check_structural_predictions(const Case& antenna, PhysicalChecks& found);
void check_structural_fractions(const Case& antenna, PhysicalChecks& found);
void check_motors_held_antennas(const Case& antenna, PhysicalChecks& found);
void check_gear_stiffness(const Case& antenna, PhysicalChecks& found);
void check_ensemble_ranges(const Case& antenna, PhysicalChecks& found);
void check_carrier_frequencies(const Case& antenna, PhysicalChecks& found);
void check_friction_slope(const Case& antenna, PhysicalChecks& found);
void check_friction_against_supply(const Case& antenna, PhysicalChecks& found);
void check_friction_tests(const Case& antenna, PhysicalChecks& found);
void check_friction_curve_tests(const Case& antenna, PhysicalChecks& found);
void check_coulomb_levels(const Case& antenna, PhysicalChecks& found);
void check_impulse_order(const Case& antenna, PhysicalChecks& found);
void check_valve_stroke(const Case& antenna, PhysicalChecks& found);
void check_inertia_against_dish(const Case& antenna, PhysicalChecks& found);
void check_flywheels(const Case& antenna, PhysicalChecks& found);
void check_return_pressures(const Case& antenna, PhysicalChecks& found);
void check_recorder_limit(const Case& antenna, PhysicalChecks& found);

}  // namespace boresight::io
