#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/audit/check_sentences.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::app {
namespace {

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
  return fmt::format("whose motors-locked modes have inertia fractions {}",
                     fmt::join(fractions, ", "));
}

// What would make the plant's gear spring as stiff as stated.
std::string gear_remedy(const FailedCheck& failed) {
  const std::string& explanation = failed.check.explanation;
  if (explanation == "held_frequencies") {
    return "Motors-locked frequencies, their inertia fractions, antenna.inertia or the stated "
           "stiffness is wrong.";
  }
  if (explanation == "missing_modes") {
    return "Without modes the stiffness is antenna.inertia (2 pi locked_rotor_frequency)^2: one of "
           "these or the stated stiffness is wrong, or modes are missing.";
  }
  const design::CheckedEntry& entry = failed.check.entries.at(0);
  if (explanation == "other_antenna") {
    const plant::StructureSpecification other =
        io::structure_specifications(*failed.antenna.structure)
            .at(static_cast<std::size_t>(entry.value));
    return fmt::format(
        "Another antenna with these motors-locked frequencies has {:.4g} N.m/rad with {}, {}. To "
        "select it, state these as effective_fraction instead of inertia_fraction.",
        failed.antenna.antenna->inertia.value * plant::make_structure(other).gear_stiffness,
        held_frequencies(other), effective_fractions(other));
  }
  if (explanation == "inputs") {
    return fmt::format(
        "No frequency of the mode of largest inertia ({}, {:.4g} Hz) above locked_rotor_frequency "
        "reproduces the stated value: antenna.inertia, locked_rotor_frequency or the stated "
        "stiffness is wrong.",
        entry.id, entry.value);
  }
  return fmt::format(
      "The mode of largest inertia ({}) at {:.4g} Hz instead of {:.4g} Hz would reproduce the "
      "stated value.",
      entry.id, failed["mode of largest inertia for it"], entry.value);
}

std::string inertia_remainder_sentence(const FailedCheck& failed) {
  const double remainder = failed["remainder"], antenna = failed["antenna"];
  return fmt::format(
      "{:.4g} kg.m2 {} less {:.4g} of the motors and {:.4g} of the gear train leaves {:.3g} kg.m2 "
      "for the antenna, which needs {:.3g}{}.",
      failed["inertia"], failed.check.explanation == "recomputed" ? "recomputed" : "as printed",
      failed["motors"], failed["gear train"], remainder, antenna,
      remainder < 0.0 ? ": no antenna has a negative inertia"
                      : fmt::format(": {:.0f} %", 100.0 * remainder / antenna));
}

std::string resonance_expected_sentence(const FailedCheck& failed) {
  std::string others;
  const auto& alternatives = failed.antenna.antenna->alternatives;
  for (std::size_t i = 0; i < alternatives.size(); ++i) {
    others += fmt::format("; the flexible antenna has {:.3f} Hz with the inertia of {}",
                          failed.check.numbers.at(5 + i).value, alternatives[i].name);
  }
  return fmt::format(
      "{} A rigid antenna would have {:.3f} Hz, no antenna {:.3f} Hz{}. Stiffness, inertias or the "
      "reading of the spectrum is wrong.",
      resonance_sentence(failed.physics.resonance.value()), failed["all masses rigid"],
      failed["without the antenna"], others);
}

std::string resonance_damping_sentence(const FailedCheck& failed) {
  const double measured = failed["measured"], expected = failed["expected"];
  const auto& verdict = failed.physics.resonance;
  const bool above = measured > expected;
  return fmt::format(
      "The {} of the case has the damping ratio {:.3g} (leakage rate {:.3g} 1/s, viscous friction "
      "{:.3g} N.m.s/rad, structural damping). Measured is {:.3g}, more than a factor of 2 {}: "
      "leakage or friction is {} than stated{}.{}",
      failed.antenna.resonance->of_oil ? "mode with most energy in the oil" : "hydraulic mode",
      expected, failed.antenna.drive->leakage_rate.value,
      failed.antenna.drive->viscous_friction.value, measured, above ? "above" : "below",
      above ? "larger" : "smaller",
      above ? ", or a nonlinear effect damped that test: dry friction, or pressure-dependent flow "
              "through an open valve"
            : "",
      verdict ? which_was_measured(*verdict) : "");
}

std::string impulse_order_sentence(const FailedCheck& failed) {
  const auto& entries = failed.check.entries;
  const double acceleration = failed["deceleration it would take"];
  return fmt::format(
      "Subtracting {:.3g} N.m more friction ({} instead of {}) must lower the inertia of an "
      "accelerating window; the stated one is {:.3g} kg.m2 higher. Either the two are exchanged, "
      "or the windows decelerate at {:.3g} rad/s2: {:.3g} N.m of braking, of which friction gives "
      "{:.3g} N.m.",
      failed["friction difference"], entries.at(0).id, entries.at(1).id,
      failed["inertia difference"], acceleration, acceleration * entries.at(0).value,
      entries.at(2).value);
}

std::string coincidence_sentence(const FailedCheck& failed) {
  const auto& entries = failed.check.entries;
  return fmt::format(
      "'{}' is stated for {} and for {}: two methods agree to the last digit. Do not count them as "
      "independent before that is explained.",
      entries.at(0).text, entries.at(1).id, entries.at(0).id);
}

std::string inertia_against_dish_sentence(const FailedCheck& failed) {
  const io::AntennaEntry& antenna = *failed.antenna.antenna;
  const auto& figure = failed.check.numbers.front();
  return fmt::format(
      "'{}' over the fifth power of the dish's '{}' is {:.2g} kg/m3. DSS-14: {:.3g} kg/m3 about "
      "elevation with 64 m, {:.3g} about elevation and {:.3g} about azimuth with 70 m "
      "(Sommerville, section II). Similar structures keep that value at any size: inertia or "
      "diameter is in another unit{}.",
      antenna.inertia.text, antenna.dish_diameter.text, figure.value, io::dss14_inertia_figures[0],
      io::dss14_inertia_figures[1], io::dss14_inertia_figures[2],
      figure.value < figure.lower ? ", or the inertia is that of a part"
                                  : ", or the diameter is a radius");
}

std::string flywheel_rim_sentence(const FailedCheck& failed) {
  return fmt::format(
      "At the slew rate of '{}' ({:.3g} rad/s at the motors) the rim of a flywheel disk of radius "
      "'{}' runs at {:.3g} m/s. Plain steel disks with a bore yield from about 200 m/s: check "
      "radius and unit, slew rate and gear ratio.",
      failed.antenna.drive->slew_rate.text, failed["motor rate at slew rate"],
      failed.antenna.motor->disk_radius.value().text, failed["rim speed"]);
}

std::string flywheel_inertia_sentence(const FailedCheck& failed) {
  const io::MotorEntry& motor = *failed.antenna.motor;
  const double disks = failed["flywheel disks"], rest = failed["all else at the motors"];
  return fmt::format(
      "{:.0f} flywheel disks of {:.3g} kg.m2 on each of {} motors have {:.3g} kg.m2, {:.0f} times "
      "the rest of the axis ({:.3g} kg.m2 at the motors). A disk's dimensions or inertia are in "
      "another unit, or are those of all disks.",
      motor.flywheel_disks, motor.disk_inertia.value, motor.count, disks, disks / rest, rest);
}

std::string wave_speed_sentence(const FailedCheck& failed) {
  const auto& first = failed.check.numbers.at(0);
  const auto& second = failed.check.numbers.at(1);
  // The bounds are two standard uncertainties to either side.
  const double uncertainty = 0.25 * (second.upper - second.lower);
  return fmt::format(
      "The wave speed of the oil is {:.4g} m/s by {} and {:.4g} m/s by {}: {:.1f} standard "
      "uncertainties apart, {:.1f} % in bulk modulus.",
      first.value, first.name, second.value, second.name,
      std::abs(second.value - first.value) / uncertainty,
      100.0 * (std::pow(first.value / second.value, 2) - 1.0));
}

std::string structural_bound_sentence(const FailedCheck& failed) {
  const io::StructureEntry& structure = *failed.antenna.structure;
  return fmt::format(
      "'{}' is the lowest structural frequency predicted for the {} axis; it does not bound the "
      "resonances of the {} axis.",
      structure.lowest_predicted.value().text, structure.lowest_predicted_axis,
      failed.antenna.axis);
}

std::string structural_predictions_sentence(const FailedCheck& failed) {
  std::vector<std::string> apart;
  for (std::size_t i = 0; i < failed.check.entries.size(); ++i) {
    const design::CheckedEntry& predicted = failed.check.entries[i];
    const double frequency = failed.check.numbers.at(2 * i + 1).value;
    apart.push_back(fmt::format("{:.4g} Hz for '{}' ({:+.0f} %)", frequency, predicted.text,
                                100.0 * (frequency / predicted.value - 1.0)));
  }
  return fmt::format(
      "With the motors locked the plant of [structure] has {}, more than 5 % from "
      "structure.prediction. The mode frequencies or inertia fractions are not those of the "
      "structural model{}.",
      fmt::join(apart, ", "),
      failed.antenna.structure->motors_held ? ""
                                            : ", or motors-locked frequencies are stated as "
                                              "bull-gear-locked ones (structure.mode_frequencies)");
}

std::string structural_fractions_sentence(const FailedCheck& failed) {
  const auto& entries = failed.check.entries;
  std::vector<std::string> fractions;
  for (std::size_t i = 0; i + 1 < entries.size(); i += 2) {
    fractions.push_back(fmt::format("a {} of {:.3g} on an inertia fraction of {:.3g}",
                                    entries[i].id.substr(entries[i].id.rfind('.') + 1),
                                    entries[i].value, entries[i + 1].value));
  }
  return fmt::format(
      "A mode of [structure] has most of the wind or boresight participation with little of the "
      "inertia: {}. It deflects the boresight from the encoder by {:.3g} mdeg in the mean wind of "
      "{:.3g} m/s; with fractions equal to those of the inertia, by {:.3g} mdeg. This flexure "
      "dominates the pointing error: take the fractions from a structural model "
      "(structure.modes_file).",
      fmt::join(fractions, " and "), failed["bending by the stated fractions"] / millidegree,
      failed.antenna.wind->design_speed.value,
      failed["bending by the fractions of the inertia"] / millidegree);
}

std::string motors_held_sentence(const FailedCheck& failed) {
  const auto& springs = failed.check.numbers;
  const auto antennas = io::structure_specifications(*failed.antenna.structure);
  std::vector<std::string> others;
  for (std::size_t i = 1; i < antennas.size(); ++i) {
    others.push_back(fmt::format("{:.3g} N.m/rad with {}, {}", springs.at(i).value,
                                 held_frequencies(antennas[i]), effective_fractions(antennas[i])));
  }
  return fmt::format(
      "{} antennas with these inertia fractions have the stated motors-locked frequencies. The "
      "studies use the one with the softest gear spring: {:.3g} N.m/rad at the motor shaft, "
      "bull-gear-locked modes at {}, {}. Alternatives: {}. To select one, state effective_fraction "
      "instead of inertia_fraction, from a structural model with the motors locked, or the "
      "stiffness of gears and bearings.",
      antennas.size(), springs.at(0).value, held_frequencies(antennas[0]),
      effective_fractions(antennas[0]), fmt::join(others, "; "));
}

std::string gear_stiffness_sentence(const FailedCheck& failed) {
  const double stated = failed["stated"], own = failed["plant"];
  return fmt::format(
      "structure.gear_stiffness gives {:.4g} N.m/rad at the antenna's axis. The plant's gear "
      "spring has {:.4g} N.m/rad there and is {:.3g} times as {}; it follows from "
      "locked_rotor_frequency, antenna.inertia and the modes. {}",
      stated, own, std::max(own, stated) / std::min(own, stated), own > stated ? "stiff" : "soft",
      gear_remedy(failed));
}

std::string ensemble_range_sentence(const FailedCheck& failed) {
  const auto& entries = failed.check.entries;
  const auto& numbers = failed.check.numbers;
  std::vector<std::string> narrow;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    narrow.push_back(
        fmt::format("{} of {:.3g} to {:.3g} times the number, where the uncertainty of {} leaves "
                    "{:.3g} to {:.3g}",
                    entries.at(i).id, numbers[i].value, numbers[i + 1].value, entries.at(i + 1).id,
                    numbers[i].upper, numbers[i + 1].lower));
  }
  return fmt::format(
      "[ensemble] is narrower than the case's own uncertainties (1 -+ sqrt(3) u): {}. Widen it: "
      "robust designs omit antennas that the case allows.",
      fmt::join(narrow, "; "));
}

std::string carrier_frequency_sentence(const FailedCheck& failed) {
  return fmt::format(
      "At '{}' the wavelength is {:.3g} m for a dish of {:.3g} m: a beam {:.2g} deg wide needs no "
      "pointing.",
      failed.check.entries.at(0).text, failed["wavelength"],
      failed.antenna.antenna->dish_diameter.value, failed["beam width"] / degree);
}

constexpr std::array of_antenna{
    CheckWording{"inertia_remainder", "inertia remainder", &inertia_remainder_sentence},
    CheckWording{"resonance_expected", "resonance expected", &resonance_expected_sentence},
    CheckWording{"resonance_damping", "resonance damping", &resonance_damping_sentence},
    CheckWording{"impulse_order", "impulse order", &impulse_order_sentence},
    CheckWording{"coincidence", "coincidence", &coincidence_sentence},
    CheckWording{"inertia_against_dish", "inertia against the dish",
                 &inertia_against_dish_sentence},
    CheckWording{"flywheel_rim", "flywheel", &flywheel_rim_sentence},
    CheckWording{"flywheel_inertia", "flywheel", &flywheel_inertia_sentence},
    CheckWording{"wave_speed", "wave speed", &wave_speed_sentence},
    CheckWording{"structural_bound", "structural bound", &structural_bound_sentence},
    CheckWording{"structural_predictions", "structural predictions",
                 &structural_predictions_sentence},
    CheckWording{"structural_shares", "structural fractions", &structural_fractions_sentence},
    CheckWording{"motors_held", "motors held", &motors_held_sentence},
    CheckWording{"gear_stiffness", "gear stiffness", &gear_stiffness_sentence},
    CheckWording{"ensemble_range", "ensemble range", &ensemble_range_sentence},
    CheckWording{"carrier_frequency", "carrier frequency", &carrier_frequency_sentence},
};

}  // namespace

std::span<const CheckWording> antenna_wordings() {
  return of_antenna;
}

}  // namespace boresight::app
