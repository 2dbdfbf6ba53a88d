#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/app/io/structure_numbers.hpp>
#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/report/sky_units.hpp>
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

std::string effective_fractions(const plant::StructureSpecification& antenna) {
  std::vector<std::string> fractions;
  for (const auto& mode : plant::motors_held_modes(plant::make_structure(antenna))) {
    fractions.push_back(fmt::format("{:.3f}", mode.inertia_fraction));
  }
  return fmt::format("whose motors-held modes have {} of the inertia", fmt::join(fractions, ", "));
}

// With every body's shares of wind and beam those of the inertia.
Case with_inertial_shares(Case antenna) {
  StructureEntry& structure = antenna.structure;
  double bull_gear = 1.0;
  for (auto& mode : structure.modes) {
    mode.wind_fraction.value = mode.beam_weight.value = mode.inertia_fraction.value;
    bull_gear -= mode.inertia_fraction.value;
  }
  structure.bull_gear_wind_fraction.value = structure.bull_gear_beam_weight.value = bull_gear;
  return antenna;
}

}  // namespace

// A mode of little inertia that takes nearly all of wind or beam is soft under it: its modal
// stiffness goes with its inertia.
void check_structural_shares(const CaseNumbers& numbers, Implausibilities& found) {
  constexpr double large = 0.5, clear_factor = 3.0;
  std::vector<std::string> shares;
  std::string first;
  for (const auto& mode : numbers.antenna.structure.modes) {
    const double inertia = mode.inertia_fraction.value;
    for (const auto& [name, share] : {std::pair{"wind_fraction", &mode.wind_fraction},
                                      std::pair{"beam_weight", &mode.beam_weight}}) {
      // Those of a modes file were computed, and are nobody's guess.
      if (share->text.empty() || share->value <= std::max(large, clear_factor * inertia)) continue;
      if (shares.empty()) first = share->key;
      shares.push_back(fmt::format("a {} of {:.3g} on an inertia fraction of {:.3g}", name,
                                   share->value, inertia));
    }
  }
  if (shares.empty()) return;
  const auto bending = [](const Case& antenna) {
    return std::abs(static_bending(make_problem(antenna))) / millidegree;
  };
  const double stated = bending(numbers.antenna);
  const double inertial = bending(with_inertial_shares(numbers.antenna));
  found.push_back(
      {"structural shares",
       first,
       fmt::format(
           "A mode of [structure] takes most of wind or beam with little of the inertia, {}: "
           "so soft a part bends the beam by {:.3g} mdeg from the encoder under the mean "
           "wind of {:.3g} m/s; with shares of wind and beam equal to those of the inertia "
           "it would be {:.3g} mdeg. Such bending decides the pointing error, and no loop "
           "sees it: take the shares from a structural model (structure.modes_file).",
           fmt::join(shares, " and "), stated, numbers.antenna.wind.design_speed.value, inertial),
       {{"bending by the stated shares", stated, "mdeg"},
        {"bending by the shares of the inertia", inertial, "mdeg"}}});
}

void check_structural_predictions(const CaseNumbers& numbers, Implausibilities& found) {
  const auto& predicted = numbers.antenna.campaign.locked_rotor_frequencies;
  if (predicted.empty()) return;
  constexpr double agrees = 0.05;
  const auto own = plant::motors_held_modes(
      plant::make_structure(structure_specification(numbers.antenna.structure)));
  std::vector<std::string> apart;
  std::vector<NamedNumber> compared;
  for (std::size_t i = 0; i < std::min(own.size(), predicted.size()); ++i) {
    const double frequency = own[i].frequency;
    const double difference = frequency / predicted[i].value - 1.0;
    if (std::abs(difference) <= agrees) continue;
    apart.push_back(fmt::format("{:.4g} Hz for '{}' ({:+.0f} %)", frequency, predicted[i].text,
                                100.0 * difference));
    compared.push_back({predicted[i].key, predicted[i].value, "Hz"});
    compared.push_back({"plant for " + predicted[i].key, frequency, "Hz"});
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
    others.push_back(fmt::format("{:.3g} N.m/rad with {}, {}", spring,
                                 held_frequencies(antennas[i]), effective_fractions(antennas[i])));
  }
  found.push_back(
      {"motors held", "structure.mode_frequencies",
       fmt::format(
           "{} antennas of these inertia fractions have the stated frequencies with the "
           "motors held; the studies take the one with the softest gear spring, {:.3g} "
           "N.m/rad at the motor shaft with modes at {} with the bull gear held, {}, and it "
           "may as well be {}: the effective inertia fractions of a structural model with "
           "the motors braked say which, and as effective_fraction in the place of "
           "inertia_fraction give that one alone; or the stiffness of gears and bearings does.",
           antennas.size(), springs[0].value, held_frequencies(antennas[0]),
           effective_fractions(antennas[0]), fmt::join(others, "; or ")),
       std::move(springs)});
}

}  // namespace boresight::app
