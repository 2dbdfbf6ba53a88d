#include <utility>

#include <boresight/design/audit/source_reading.hpp>
#include <boresight/io/audit/case_checks.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/drive_numbers.hpp>

namespace boresight::io {
namespace {

double from_nearest_prints(const design::AuditGraph& graph, const std::string& id) {
  const std::size_t node = graph.index(id);
  if (graph.is_input(node)) return graph.value(node, {});
  return graph.derive(node, design::values_of(graph, design::reading_in_column(graph, node, 0)));
}

}  // namespace

design::PhysicalCheck& begin_check(PhysicalChecks& found, std::string id, std::string quantity,
                                   bool holds) {
  return found.checks.emplace_back(
      design::PhysicalCheck{std::move(id), std::move(quantity), holds, {}, {}, {}});
}

design::CheckedEntry entry_of(const Quantity& quantity) {
  return {quantity.key, quantity.text, quantity.value, quantity.basis == Basis::assumed};
}

ShaftNumbers shaft_numbers(const Case& antenna, const design::AuditGraph& graph) {
  ShaftNumbers shaft;
  shaft.motors = from_nearest_prints(graph, "motor_inertia");
  for (const RotatingAssembly& assembly : antenna.gear_train->assemblies) {
    shaft.gear_train += from_nearest_prints(graph, "load_inertia." + assembly.name);
  }
  shaft.antenna = from_nearest_prints(graph, "load_inertia.antenna");
  shaft.oil_stiffness = from_nearest_prints(graph, "oil_stiffness");
  shaft.supply_torque = supply_torque(antenna);
  shaft.slew_rate = antenna.drive->slew_rate.value * from_nearest_prints(graph, "gear_ratio");
  return shaft;
}

PhysicalChecks check_physics(const Case& antenna, const design::AuditGraph& graph) {
  PhysicalChecks found{shaft_numbers(antenna, graph), resonance_verdict(antenna), {}};
  for (const auto check : {check_inertia_remainders,
                           check_expected_resonance,
                           check_resonance_damping,
                           check_impulse_order,
                           check_coincidences,
                           check_friction_slope,
                           check_friction_against_supply,
                           check_friction_tests,
                           check_friction_curve_tests,
                           check_coulomb_levels,
                           check_valve_stroke,
                           check_inertia_against_dish,
                           check_flywheels,
                           check_return_pressures,
                           check_recorder_limit,
                           check_wave_speeds,
                           check_structural_bound,
                           check_structural_predictions,
                           check_structural_fractions,
                           check_motors_held_antennas,
                           check_gear_stiffness,
                           check_ensemble_ranges,
                           check_carrier_frequencies}) {
    check(antenna, found);
  }
  return found;
}

}  // namespace boresight::io
