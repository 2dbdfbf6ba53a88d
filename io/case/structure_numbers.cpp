#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::io {

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

double locked_rotor_frequency_for(plant::StructureSpecification antenna, double gear_stiffness) {
  const auto stiffness = [&](double frequency) {
    antenna.locked_rotor_frequency = frequency;
    return plant::make_structure(antenna).gear_stiffness;
  };
  // The stiffness rises with the frequency, without bound towards the lowest mode, and is no less
  // than that of a rigid antenna.
  double lower = 0.0;
  double upper = std::sqrt(gear_stiffness / antenna.antenna_inertia) / two_pi;
  for (const auto& mode : antenna.modes) upper = std::min(upper, mode.frequency);
  double middle = std::midpoint(lower, upper);
  while (lower < middle && middle < upper) {
    (stiffness(middle) < gear_stiffness ? lower : upper) = middle;
    middle = std::midpoint(lower, upper);
  }
  constexpr double rounding = 1e-6;
  const bool found = lower > 0.0 && std::abs(stiffness(lower) / gear_stiffness - 1.0) <= rounding;
  if (!found) {
    throw InvalidInput(fmt::format(
        "expected a stiffness that leaves the locked-rotor frequency above 0 and below every mode, "
        "found one that takes it to {:.6g} Hz",
        lower));
  }
  return lower;
}

}  // namespace boresight::io
