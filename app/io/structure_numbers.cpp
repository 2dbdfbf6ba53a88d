#include <boresight/app/io/structure_numbers.hpp>
#include <boresight/plant/motors_held_modes.hpp>

namespace boresight::app {

plant::StructureSpecification structure_specification(const StructureEntry& structure) {
  return structure_specifications(structure).front();
}

std::vector<plant::StructureSpecification> structure_specifications(
    const StructureEntry& structure) {
  plant::StructureSpecification specification;
  specification.antenna_inertia = 1.0;
  specification.bull_gear_wind_fraction = structure.bull_gear_wind_fraction.value;
  specification.bull_gear_beam_weight = structure.bull_gear_beam_weight.value;
  specification.locked_rotor_frequency = structure.locked_rotor_frequency.value;
  specification.gear_damping_ratio = structure.gear_damping_ratio.value;
  bool effective = false;
  for (const auto& mode : structure.modes) {
    effective = effective || mode.effective_fraction.has_value();
    const double fraction =
        mode.effective_fraction ? mode.effective_fraction->value : mode.inertia_fraction.value;
    specification.modes.push_back({mode.frequency.value, mode.damping_ratio.value, fraction,
                                   mode.wind_fraction.value, mode.beam_weight.value});
  }
  if (!structure.motors_held) return {specification};
  if (effective) return {plant::antenna_of_effective_fractions(specification)};
  return plant::hold_bull_gear_of(specification);
}

}  // namespace boresight::app
