#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

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
io::Case with_inertial_shares(io::Case antenna) {
  io::StructureEntry& structure = antenna.structure;
  double bull_gear = 1.0;
  for (auto& mode : structure.modes) {
    mode.wind_fraction.value = mode.beam_weight.value = mode.inertia_fraction.value;
    bull_gear -= mode.inertia_fraction.value;
  }
  structure.bull_gear_wind_fraction.value = structure.bull_gear_beam_weight.value = bull_gear;
  return antenna;
}

double gear_stiffness_at_axis(const io::Case& antenna,
                              const plant::StructureSpecification& structure) {
  return antenna.antenna.inertia.value * plant::make_structure(structure).gear_stiffness;
}

double factor_between(double one, double other) {
  return std::max(one, other) / std::min(one, other);
}

// Up to which the stated stiffness of the gear train and the plant's are one.
double agreeing_factor(const io::Case& antenna, const io::Quantity& stiffness) {
  constexpr double usual = 1.3, least = 1.05, deviations = 3.0;
  if (!stiffness.uncertainty_given) return usual;
  const auto stated = [](const io::Quantity& quantity) {
    return quantity.uncertainty_given ? io::relative_uncertainty(quantity) : 0.0;
  };
  // The plant's goes with the inertia and with the square of the frequencies.
  const double uncertainty = std::hypot(stated(stiffness), stated(antenna.antenna.inertia),
                                        2.0 * stated(antenna.structure.locked_rotor_frequency));
  return std::max(least, 1.0 + deviations * uncertainty);
}

// Frequency (Hz) of the heaviest mode by which, all else kept, the gear spring of the antenna has
// this stiffness, which falls as the mode rises; none that a case may state, or too close to the
// locked-rotor frequency to be meant.
std::optional<double> heaviest_mode_for(plant::StructureSpecification antenna, std::size_t heaviest,
                                        double stiffness) {
  constexpr double clear = 1.001, highest = 1000.0;
  double& frequency = antenna.modes.at(heaviest).frequency;
  double lower = clear * antenna.locked_rotor_frequency;
  double upper = std::max(highest, frequency);
  const auto is_stiffer = [&](double at) {
    frequency = at;
    return plant::make_structure(antenna).gear_stiffness > stiffness;
  };
  if (!is_stiffer(lower) || is_stiffer(upper)) return std::nullopt;
  double middle = std::midpoint(lower, upper);
  while (lower < middle && middle < upper) {
    (is_stiffer(middle) ? lower : upper) = middle;
    middle = std::midpoint(lower, upper);
  }
  return upper;
}

// Of frequencies with the motors held: another antenna of these, if one has the stated stiffness.
std::string other_antenna_for(const io::Case& antenna, double stiffness, double agreeing) {
  for (const auto& other : io::structure_specifications(antenna.structure)) {
    const double own = gear_stiffness_at_axis(antenna, other);
    if (factor_between(own, stiffness) > agreeing) continue;
    return fmt::format(
        "Another antenna of these frequencies with the motors held has {:.4g} N.m/rad with {}, {}: "
        "stated as effective_fraction in the place of inertia_fraction, these take it.",
        own, held_frequencies(other), effective_fractions(other));
  }
  return "Frequencies with the motors held, their fractions, antenna.inertia or the stated "
         "stiffness is wrong.";
}

// What would make the plant's gear spring as stiff as stated; a frequency is noted.
std::string gear_remedy(const io::Case& antenna, double stiffness, double agreeing,
                        std::vector<NamedNumber>& compared) {
  const io::StructureEntry& structure = antenna.structure;
  if (structure.motors_held) return other_antenna_for(antenna, stiffness, agreeing);
  const auto& modes = structure.modes;
  if (modes.empty()) {
    return "Without modes it is antenna.inertia times the square of 2 pi locked_rotor_frequency: "
           "one of these or the stated stiffness is wrong, or modes are missing.";
  }
  const auto heaviest = std::ranges::max_element(
      modes, {}, [](const io::StructureModeEntry& mode) { return mode.inertia_fraction.value; });
  const auto found = heaviest_mode_for(io::structure_specification(structure),
                                       static_cast<std::size_t>(heaviest - modes.begin()),
                                       stiffness / antenna.antenna.inertia.value);
  if (!found) {
    return fmt::format(
        "No frequency of its heaviest mode ({}, {:.4g} Hz) clearly above locked_rotor_frequency "
        "makes it so, all else kept: antenna.inertia, locked_rotor_frequency or the stated "
        "stiffness is wrong.",
        heaviest->frequency.key, heaviest->frequency.value);
  }
  compared.push_back({"heaviest mode for it", *found, "Hz"});
  return fmt::format(
      "With its heaviest mode ({}) at {:.4g} Hz in the place of {:.4g}, all else kept, it is as "
      "stated.",
      heaviest->frequency.key, *found, heaviest->frequency.value);
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
  const auto bending = [](const io::Case& antenna) {
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
      plant::make_structure(io::structure_specification(numbers.antenna.structure)));
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
  const auto antennas = io::structure_specifications(numbers.antenna.structure);
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

void check_gear_stiffness(const CaseNumbers& numbers, Implausibilities& found) {
  const io::Case& antenna = numbers.antenna;
  const auto& stated = antenna.structure.gear_stiffness;
  if (!stated) return;
  const double own =
      gear_stiffness_at_axis(antenna, io::structure_specification(antenna.structure));
  const double agreeing = agreeing_factor(antenna, *stated);
  const double factor = factor_between(own, stated->value);
  if (factor <= agreeing) return;
  std::vector<NamedNumber> compared{{"stated", stated->value, "N.m/rad"},
                                    {"plant", own, "N.m/rad"}};
  const std::string remedy = gear_remedy(antenna, stated->value, agreeing, compared);
  found.push_back(
      {"gear stiffness", stated->key,
       fmt::format("The gear train of structure.gear_stiffness has {:.4g} N.m/rad at the antenna's "
                   "axis, the plant's gear spring there {:.4g} N.m/rad and is {:.3g} times as {}: "
                   "it follows from locked_rotor_frequency, antenna.inertia and the modes. {}",
                   stated->value, own, factor, own > stated->value ? "stiff" : "soft", remedy),
       std::move(compared)});
}

}  // namespace boresight::app
