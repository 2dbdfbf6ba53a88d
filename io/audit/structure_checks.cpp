#include <algorithm>
#include <cmath>
#include <string>

#include <boresight/design/audit/gear_stiffness.hpp>
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/io/audit/case_checks.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::io {
namespace {

// With every body's fractions of wind and beam those of the inertia.
Case with_inertial_fractions(Case antenna) {
  StructureEntry& structure = *antenna.structure;
  double bull_gear = 1.0;
  for (auto& mode : structure.modes) {
    mode.wind_fraction.value = mode.beam_weight.value = mode.inertia_fraction.value;
    bull_gear -= mode.inertia_fraction.value;
  }
  structure.bull_gear_wind_fraction.value = structure.bull_gear_beam_weight.value = bull_gear;
  return antenna;
}

// Of the beam from the encoder in the mean wind (rad).
double mean_bending(const Case& antenna) {
  return std::abs(static_bending(make_problem(antenna)));
}

double gear_stiffness_at_axis(const Case& antenna, const plant::StructureSpecification& structure) {
  return antenna.antenna->inertia.value * plant::make_structure(structure).gear_stiffness;
}

double factor_between(double one, double other) {
  return std::max(one, other) / std::min(one, other);
}

// Up to which the stated stiffness of the gear train and the plant's are one.
double agreeing_factor(const Case& antenna, const Quantity& stiffness) {
  constexpr double usual = 1.3, minimum = 1.05, deviations = 3.0;
  if (!stiffness.uncertainty_given) return usual;
  const auto stated = [](const Quantity& quantity) {
    return quantity.uncertainty_given ? relative_uncertainty(quantity) : 0.0;
  };
  // The plant's scales with the inertia and with the square of the frequencies.
  const double uncertainty = std::hypot(stated(stiffness), stated(antenna.antenna->inertia),
                                        2.0 * stated(antenna.structure->locked_rotor_frequency));
  return std::max(minimum, 1.0 + deviations * uncertainty);
}

// What would make the plant's gear spring as stiff as stated.
void explain_gear_stiffness(const Case& antenna, double stiffness, double agreeing,
                            design::PhysicalCheck& check) {
  const StructureEntry& structure = *antenna.structure;
  if (structure.motors_held) {
    check.explanation = "held_frequencies";
    const auto antennas = structure_specifications(structure);
    const auto other = std::ranges::find_if(antennas, [&](const auto& one) {
      return factor_between(gear_stiffness_at_axis(antenna, one), stiffness) <= agreeing;
    });
    if (other == antennas.end()) return;
    check.explanation = "other_antenna";
    check.entries = {
        {"structure.mode_frequencies", "", static_cast<double>(other - antennas.begin())}};
    return;
  }
  const auto& modes = structure.modes;
  if (modes.empty()) {
    check.explanation = "missing_modes";
    return;
  }
  const auto heaviest = std::ranges::max_element(
      modes, {}, [](const StructureModeEntry& mode) { return mode.inertia_fraction.value; });
  check.entries = {entry_of(heaviest->frequency)};
  const auto frequency = design::mode_frequency_for(
      structure_specification(structure), static_cast<std::size_t>(heaviest - modes.begin()),
      stiffness / antenna.antenna->inertia.value);
  check.explanation = frequency ? "heaviest_mode" : "inputs";
  if (frequency) check.add("mode of largest inertia for it", *frequency, "Hz");
}

}  // namespace

void check_structural_bound(const Case& antenna, PhysicalChecks& found) {
  const StructureEntry& structure = *antenna.structure;
  if (!structure.lowest_predicted) return;
  auto& check = begin_check(found, "structural_bound", "structure.lowest_predicted",
                            structure.lowest_predicted_axis == antenna.axis);
  check.add("lowest predicted", structure.lowest_predicted->value, "Hz");
}

// A mode of little inertia that takes nearly all of wind or beam is soft under it: its modal
// stiffness scales with its inertia.
void check_structural_fractions(const Case& antenna, PhysicalChecks& found) {
  constexpr double large = 0.5, clear_factor = 3.0;
  auto& check = begin_check(found, "structural_shares", "structure.mode");
  for (const auto& mode : antenna.structure->modes) {
    const Quantity& inertia = mode.inertia_fraction;
    for (const Quantity* fraction : {&mode.wind_fraction, &mode.beam_weight}) {
      // Those of a modes file were computed, and are nobody's guess.
      if (fraction->text.empty() ||
          fraction->value <= std::max(large, clear_factor * inertia.value)) {
        continue;
      }
      check.entries.push_back(entry_of(*fraction));
      check.entries.push_back(entry_of(inertia));
    }
  }
  if (!check.entries.empty()) {
    check.quantity = check.entries.front().id;
    check.holds = false;
    check.add("bending by the stated fractions", mean_bending(antenna), "rad");
    check.add("bending by the fractions of the inertia",
              mean_bending(with_inertial_fractions(antenna)), "rad");
  }
}

void check_structural_predictions(const Case& antenna, PhysicalChecks& found) {
  const auto& predicted = antenna.campaign->locked_rotor_frequencies;
  if (predicted.empty()) return;
  constexpr double agrees = 0.05;
  const auto own =
      plant::motors_held_modes(plant::make_structure(structure_specification(*antenna.structure)));
  auto& check = begin_check(found, "structural_predictions", "structure.prediction");
  for (std::size_t i = 0; i < std::min(own.size(), predicted.size()); ++i) {
    const Quantity& one = predicted[i];
    if (std::abs(own[i].frequency / one.value - 1.0) <= agrees) continue;
    check.holds = false;
    check.entries.push_back(entry_of(one));
    check.add(one.key, one.value, "Hz");
    check.add("plant for " + one.key, own[i].frequency, "Hz", (1.0 - agrees) * one.value,
              (1.0 + agrees) * one.value);
  }
}

void check_motors_held_antennas(const Case& antenna, PhysicalChecks& found) {
  if (!antenna.structure->motors_held) return;
  const auto antennas = structure_specifications(*antenna.structure);
  auto& check =
      begin_check(found, "motors_held", "structure.mode_frequencies", antennas.size() < 2);
  for (std::size_t i = 0; i < antennas.size(); ++i) {
    // At the motor shaft, by the antenna inertia there.
    check.add("gear spring " + std::to_string(i + 1),
              found.shaft.antenna * plant::make_structure(antennas[i]).gear_stiffness, "N.m/rad");
  }
}

void check_gear_stiffness(const Case& antenna, PhysicalChecks& found) {
  const auto& stated = antenna.structure->gear_stiffness;
  if (!stated) return;
  const double own = gear_stiffness_at_axis(antenna, structure_specification(*antenna.structure));
  const double agreeing = agreeing_factor(antenna, *stated);
  auto& check = begin_check(found, "gear_stiffness", stated->key,
                            factor_between(own, stated->value) <= agreeing);
  check.add("stated", stated->value, "N.m/rad");
  check.add("plant", own, "N.m/rad", stated->value / agreeing, stated->value * agreeing);
  if (!check.holds) explain_gear_stiffness(antenna, stated->value, agreeing, check);
}

}  // namespace boresight::io
