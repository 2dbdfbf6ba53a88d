#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/app/io/structure_numbers.hpp>
#include <boresight/plant/motors_held_modes.hpp>

namespace boresight::app {
namespace {

// Of the gear spring at the motor shaft, by the antenna inertia there.
double gear_spring(const CaseNumbers& numbers, const plant::StructureSpecification& antenna) {
  return numbers.antenna_at_motor * plant::make_structure(antenna).gear_stiffness;
}

std::string held_frequencies(const plant::StructureSpecification& antenna) {
  std::vector<std::string> frequencies;
  for (const auto& mode : antenna.modes) {
    frequencies.push_back(fmt::format("{:.4g}", mode.frequency));
  }
  return fmt::format("{} Hz", fmt::join(frequencies, ", "));
}

}  // namespace

void check_structural_predictions(const CaseNumbers& numbers, Implausibilities& found) {
  const auto& predicted = numbers.antenna.campaign.locked_rotor_frequencies;
  if (predicted.empty()) return;
  constexpr double agrees = 0.05;
  const auto own = plant::motors_held_frequencies(
      plant::make_structure(structure_specification(numbers.antenna.structure)));
  std::vector<std::string> apart;
  std::vector<NamedNumber> compared;
  for (std::size_t i = 0; i < std::min(own.size(), predicted.size()); ++i) {
    const double difference = own[i] / predicted[i].value - 1.0;
    if (std::abs(difference) <= agrees) continue;
    apart.push_back(fmt::format("{:.4g} Hz for '{}' ({:+.0f} %)", own[i], predicted[i].text,
                                100.0 * difference));
    compared.push_back({predicted[i].key, predicted[i].value, "Hz"});
    compared.push_back({"plant for " + predicted[i].key, own[i], "Hz"});
  }
  if (apart.empty()) return;
  found.push_back(
      {"structural predictions", "structure.prediction",
       fmt::format("With the motors held the plant of [structure] swings at {}, more than {:.0f} % "
                   "from what structure.prediction says: the modes' frequencies or inertia "
                   "fractions are not those of the structural model{}.",
                   fmt::join(apart, ", "), 100.0 * agrees,
                   numbers.antenna.structure.motors_held
                       ? ""
                       : ", or frequencies with the motors held stand where those with the bull "
                         "gear held belong (structure.mode_frequencies)"),
       std::move(compared)});
}

void check_motors_held_antennas(const CaseNumbers& numbers, Implausibilities& found) {
  const auto antennas = structure_specifications(numbers.antenna.structure);
  if (antennas.size() < 2) return;
  std::vector<std::string> others;
  std::vector<NamedNumber> springs;
  for (std::size_t i = 0; i < antennas.size(); ++i) {
    const double spring = gear_spring(numbers, antennas[i]);
    springs.push_back({fmt::format("gear spring {}", i + 1), spring, "N.m/rad"});
    if (i == 0) continue;
    others.push_back(fmt::format("{:.3g} N.m/rad with {}", spring, held_frequencies(antennas[i])));
  }
  found.push_back(
      {"motors held", "structure.mode_frequencies",
       fmt::format("{} antennas of these inertia fractions have the stated frequencies with the "
                   "motors held; the studies take the one with the softest gear spring, {:.3g} "
                   "N.m/rad at the motor shaft with modes at {} with the bull gear held, and it "
                   "may as well be {}: the stiffness of gears and bearings says which.",
                   antennas.size(), springs[0].value, held_frequencies(antennas[0]),
                   fmt::join(others, "; or ")),
       std::move(springs)});
}

}  // namespace boresight::app
