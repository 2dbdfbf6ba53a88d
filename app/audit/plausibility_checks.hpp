#pragma once

#include <boresight/app/audit/plausibility.hpp>

namespace boresight::app {

/// A case's numbers as the checks take them, recomputed from what is printed nearest to them (SI).
struct CaseNumbers {
  const Case& antenna;
  const identification::AuditGraph& graph;
  double motors = 0.0;            // inertia of all motors
  double gear_train = 0.0;        // load inertia without the antenna
  double antenna_at_motor = 0.0;  // antenna inertia at the motor
  double oil_stiffness = 0.0;
  double supply_torque = 0.0;
  double slew_rate_at_motor = 0.0;
};
CaseNumbers case_numbers(const Case& antenna, const identification::AuditGraph& graph);

using Implausibilities = std::vector<Implausibility>;

void check_inertia_remainders(const CaseNumbers& numbers, Implausibilities& found);
void check_expected_resonance(const CaseNumbers& numbers, Implausibilities& found);
void check_coincidences(const CaseNumbers& numbers, Implausibilities& found);
void check_structural_bound(const CaseNumbers& numbers, Implausibilities& found);
void check_wave_speeds(const CaseNumbers& numbers, Implausibilities& found);
void check_carrier_frequencies(const CaseNumbers& numbers, Implausibilities& found);
void check_friction_slope(const CaseNumbers& numbers, Implausibilities& found);
void check_friction_against_supply(const CaseNumbers& numbers, Implausibilities& found);
void check_friction_tests(const CaseNumbers& numbers, Implausibilities& found);
void check_coulomb_levels(const CaseNumbers& numbers, Implausibilities& found);
void check_impulse_order(const CaseNumbers& numbers, Implausibilities& found);
void check_valve_stroke(const CaseNumbers& numbers, Implausibilities& found);
void check_return_pressures(const CaseNumbers& numbers, Implausibilities& found);
void check_recorder_limit(const CaseNumbers& numbers, Implausibilities& found);

}  // namespace boresight::app
