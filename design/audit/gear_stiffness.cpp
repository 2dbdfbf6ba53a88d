#include <algorithm>
#include <numeric>

#include <boresight/design/audit/gear_stiffness.hpp>

namespace boresight::design {

std::optional<double> mode_frequency_for(plant::StructureSpecification antenna, std::size_t mode,
                                         double gear_stiffness) {
  constexpr double clear = 1.001, highest = 1000.0;
  double& frequency = antenna.modes.at(mode).frequency;
  double lower = clear * antenna.locked_rotor_frequency;
  double upper = std::max(highest, frequency);
  const auto is_stiffer = [&](double at) {
    frequency = at;
    return plant::make_structure(antenna).gear_stiffness > gear_stiffness;
  };
  if (!is_stiffer(lower) || is_stiffer(upper)) return std::nullopt;
  double middle = std::midpoint(lower, upper);
  while (lower < middle && middle < upper) {
    (is_stiffer(middle) ? lower : upper) = middle;
    middle = std::midpoint(lower, upper);
  }
  return upper;
}

}  // namespace boresight::design
