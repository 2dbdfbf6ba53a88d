#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/design/audit/source_reading.hpp>
#include <boresight/io/case/drive_numbers.hpp>

namespace boresight::app {
namespace {

double from_nearest_prints(const design::AuditGraph& graph, const std::string& id) {
  const std::size_t node = graph.index(id);
  if (graph.is_input(node)) return graph.value(node, {});
  return graph.derive(node, design::values_of(graph, design::reading_in_column(graph, node, 0)));
}

}  // namespace

CaseNumbers case_numbers(const io::Case& antenna, const design::AuditGraph& graph) {
  CaseNumbers numbers{antenna, graph};
  numbers.motors = from_nearest_prints(graph, "motor_inertia");
  for (const io::RotatingAssembly& assembly : antenna.gear_train.assemblies) {
    numbers.gear_train += from_nearest_prints(graph, "load_inertia." + assembly.name);
  }
  numbers.antenna_at_motor = from_nearest_prints(graph, "load_inertia.antenna");
  numbers.oil_stiffness = from_nearest_prints(graph, "oil_stiffness");
  numbers.supply_torque = io::supply_torque(antenna);
  numbers.slew_rate_at_motor =
      antenna.drive.slew_rate.value * from_nearest_prints(graph, "gear_ratio");
  return numbers;
}

std::vector<Implausibility> implausibilities(const io::Case& antenna,
                                             const design::AuditGraph& graph) {
  const CaseNumbers numbers = case_numbers(antenna, graph);
  Implausibilities found;
  check_inertia_remainders(numbers, found);
  check_expected_resonance(numbers, found);
  check_resonance_damping(numbers, found);
  check_impulse_order(numbers, found);
  check_coincidences(numbers, found);
  check_friction_slope(numbers, found);
  check_friction_against_supply(numbers, found);
  check_friction_tests(numbers, found);
  check_friction_curve_tests(numbers, found);
  check_coulomb_levels(numbers, found);
  check_valve_stroke(numbers, found);
  check_inertia_against_dish(numbers, found);
  check_flywheels(numbers, found);
  check_return_pressures(numbers, found);
  check_recorder_limit(numbers, found);
  check_wave_speeds(numbers, found);
  check_structural_bound(numbers, found);
  check_structural_predictions(numbers, found);
  check_structural_shares(numbers, found);
  check_motors_held_antennas(numbers, found);
  check_gear_stiffness(numbers, found);
  check_ensemble_ranges(numbers, found);
  check_carrier_frequencies(numbers, found);
  return found;
}

}  // namespace boresight::app
