#pragma once

#include <boresight/app/audit/plausibility.hpp>

namespace boresight::app {

/// A case's numbers as the checks take them, recomputed from what is printed nearest to them (SI).
struct CaseNumbers {
  const io::Case& antenna;
  const design::AuditGraph& graph;
  double motors = 0.0;            // inertia of all motors
  double gear_train = 0.0;        // load inertia without the antenna
  double antenna_at_motor = 0.0;  // antenna inertia at the motor
  double oil_stiffness = 0.0;
  double supply_torque = 0.0;
  double slew_rate_at_motor = 0.0;
};
CaseNumbers case_numbers(const io::Case& antenna, const design::AuditGraph& graph);

/// Torque of all motors (N m), with its standard uncertainty.
struct MotorTorque {
  double value = 0.0;
  double uncertainty = 0.0;
};
/// At the supply pressure, the return pressure not taken off.
MotorTorque torque_of_supply(const CaseNumbers& numbers);
/// By the friction curve, to first order.
MotorTorque friction_at_slew_rate(const CaseNumbers& numbers);
/// Whether that is more than the supply's torque, by more than two standard uncertainties.
bool friction_stops_slewing(const CaseNumbers& numbers);

using Implausibilities = std::vector<Implausibility>;

void check_inertia_remainders(const CaseNumbers& numbers, Implausibilities& found);
void check_expected_resonance(const CaseNumbers& numbers, Implausibilities& found);
void check_resonance_damping(const CaseNumbers& numbers, Implausibilities& found);
void check_coincidences(const CaseNumbers& numbers, Implausibilities& found);
void check_structural_bound(const CaseNumbers& numbers, Implausibilities& found);
void check_wave_speeds(const CaseNumbers& numbers, Implausibilities& found);
void check_structural_predictions(const CaseNumbers& numbers, Implausibilities& found);
void check_structural_shares(const CaseNumbers& numbers, Implausibilities& found);
void check_motors_held_antennas(const CaseNumbers& numbers, Implausibilities& found);
void check_gear_stiffness(const CaseNumbers& numbers, Implausibilities& found);
void check_ensemble_ranges(const CaseNumbers& numbers, Implausibilities& found);
void check_carrier_frequencies(const CaseNumbers& numbers, Implausibilities& found);
void check_friction_slope(const CaseNumbers& numbers, Implausibilities& found);
void check_friction_against_supply(const CaseNumbers& numbers, Implausibilities& found);
void check_friction_tests(const CaseNumbers& numbers, Implausibilities& found);
void check_friction_curve_tests(const CaseNumbers& numbers, Implausibilities& found);
void check_coulomb_levels(const CaseNumbers& numbers, Implausibilities& found);
void check_impulse_order(const CaseNumbers& numbers, Implausibilities& found);
void check_valve_stroke(const CaseNumbers& numbers, Implausibilities& found);
void check_inertia_against_dish(const CaseNumbers& numbers, Implausibilities& found);
void check_flywheels(const CaseNumbers& numbers, Implausibilities& found);
void check_return_pressures(const CaseNumbers& numbers, Implausibilities& found);
void check_recorder_limit(const CaseNumbers& numbers, Implausibilities& found);

}  // namespace boresight::app
