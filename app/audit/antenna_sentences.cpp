#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/audit/check_sentences.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
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
  return fmt::format("whose motors-held modes have {} of the inertia", fmt::join(fractions, ", "));
}

// What would make the plant's gear spring as stiff as stated.
std::string gear_remedy(const FailedCheck& failed) {
  const std::string& explanation = failed.check.explanation;
  if (explanation == "held_frequencies") {
    return "Frequencies with the motors held, their fractions, antenna.inertia or the stated "
           "stiffness is wrong.";
  }
  if (explanation == "missing_modes") {
    return "Without modes it is antenna.inertia times the square of 2 pi locked_rotor_frequency: "
           "one of these or the stated stiffness is wrong, or modes are missing.";
  }
  const design::CheckedEntry& entry = failed.check.entries.at(0);
  if (explanation == "other_antenna") {
    const plant::StructureSpecification other =
        io::structure_specifications(failed.antenna.structure)
            .at(static_cast<std::size_t>(entry.value));
    return fmt::format(
        "Another antenna of these frequencies with the motors held has {:.4g} N.m/rad with {}, {}: "
        "stated as effective_fraction in the place of inertia_fraction, these take it.",
        failed.antenna.antenna.inertia.value * plant::make_structure(other).gear_stiffness,
        held_frequencies(other), effective_fractions(other));
  }
  if (explanation == "inputs") {
    return fmt::format(
        "No frequency of its heaviest mode ({}, {:.4g} Hz) clearly above locked_rotor_frequency "
        "makes it so, all else kept: antenna.inertia, locked_rotor_frequency or the stated "
        "stiffness is wrong.",
        entry.id, entry.value);
  }
  return fmt::format(
      "With its heaviest mode ({}) at {:.4g} Hz in the place of {:.4g}, all else kept, it is as "
      "stated.",
      entry.id, failed["heaviest mode for it"], entry.value);
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
  const auto& alternatives = failed.antenna.antenna.alternatives;
  for (std::size_t i = 0; i < alternatives.size(); ++i) {
    others += fmt::format("; the flexible antenna has {:.3f} Hz with the inertia of {}",
                          failed.check.numbers.at(5 + i).value, alternatives[i].name);
  }
  return fmt::format(
      "{} All masses rigid on the oil spring would make it {:.3f} Hz, {:.3f} Hz with no antenna at "
      "all{}. Stiffness, masses or the reading of the spectrum is wrong.",
      resonance_sentence(failed.physics.resonance.value()), failed["all masses rigid"],
      failed["without the antenna"], others);
}

std::string resonance_damping_sentence(const FailedCheck& failed) {
  const double measured = failed["measured"], expected = failed["expected"];
  const auto& verdict = failed.physics.resonance;
  const bool above = measured > expected;
  return fmt::format(
      "The {} of the case has the damping ratio {:.3g}, by the leakage rate of {:.3g} 1/s, viscous "
      "friction of {:.3g} N.m.s/rad and the structure; measured is {:.3g}, more than a factor of 2 "
      "{}: leakage or friction is {} than stated{}.{}",
      failed.antenna.resonance_of_oil ? "mode of most oil" : "hydraulic mode", expected,
      failed.antenna.drive.leakage_rate.value, failed.antenna.drive.viscous_friction.value,
      measured, above ? "above" : "below", above ? "larger" : "smaller",
      above ? ", or what no linear plant has damped that test: dry friction, or the edges of a "
              "valve that stood open, which leak with the pressure"
            : "",
      verdict ? which_was_measured(*verdict) : "");
}

std::string impulse_order_sentence(const FailedCheck& failed) {
  const auto& entries = failed.check.entries;
  const double acceleration = failed["deceleration it would take"];
  return fmt::format(
      "With {:.3g} N.m more friction subtracted ({} against {}) an accelerating window must give "
      "less inertia, J falls by dT dt/dw; printed is {:.3g} kg.m2 more. Either the two are "
      "exchanged, or the windows slowed down, by {:.3g} rad/s2: {:.3g} N.m of braking, all but the "
      "friction's {:.3g} N.m from the motors.",
      failed["friction difference"], entries.at(0).id, entries.at(1).id,
      failed["inertia difference"], acceleration, acceleration * entries.at(0).value,
      entries.at(2).value);
}

std::string coincidence_sentence(const FailedCheck& failed) {
  const auto& entries = failed.check.entries;
  return fmt::format(
      "'{}' is printed for {} and for {}: two methods that agree to the last digit, which chance "
      "rarely makes; they are no independent confirmation before that is explained.",
      entries.at(0).text, entries.at(1).id, entries.at(0).id);
}

std::string inertia_against_dish_sentence(const FailedCheck& failed) {
  const io::AntennaEntry& antenna = failed.antenna.antenna;
  const auto& figure = failed.check.numbers.front();
  return fmt::format(
      "'{}' over the fifth power of the dish's '{}' is {:.2g} kg/m3; DSS-14 had {:.3g} kg/m3 about "
      "elevation with 64 m, and has {:.3g} about elevation and {:.3g} about azimuth with 70 m "
      "(Sommerville, section II), and structures alike keep that figure at any size: inertia or "
      "diameter is in another unit{}.",
      antenna.inertia.text, antenna.dish_diameter.text, figure.value, io::dss14_inertia_figures[0],
      io::dss14_inertia_figures[1], io::dss14_inertia_figures[2],
      figure.value < figure.lower ? ", or the inertia that of a part"
                                  : ", or a radius stands for the diameter");
}

std::string flywheel_rim_sentence(const FailedCheck& failed) {
  return fmt::format(
      "At the slew rate of '{}', {:.3g} rad/s of the motors, the rim of a flywheel disk of '{}' "
      "radius runs at {:.3g} m/s; plain steel disks with a bore yield from some 200 m/s: the "
      "radius may be a diameter or in another unit, or slew rate or gear ratio is wrong.",
      failed.antenna.drive.slew_rate.text, failed["motor rate at slew rate"],
      failed.antenna.motor.disk_radius.value().text, failed["rim speed"]);
}

std::string flywheel_inertia_sentence(const FailedCheck& failed) {
  const io::MotorEntry& motor = failed.antenna.motor;
  const double disks = failed["flywheel disks"], rest = failed["all else at the motors"];
  return fmt::format(
      "{:.0f} flywheel disks of {:.3g} kg.m2 on each of {} motors have {:.3g} kg.m2, {:.0f} times "
      "all that turns with them, {:.3g} kg.m2 at the motors with gear train and antenna: a disk's "
      "dimensions or inertia are in another unit, or are those of all disks.",
      motor.flywheel_disks, motor.disk_inertia.value, motor.count, disks, disks / rest, rest);
}

std::string wave_speed_sentence(const FailedCheck& failed) {
  const auto& first = failed.check.numbers.at(0);
  const auto& second = failed.check.numbers.at(1);
  // The bounds are two standard uncertainties to either side.
  const double uncertainty = 0.25 * (second.upper - second.lower);
  return fmt::format(
      "The same oil carries sound at {:.4g} m/s by {} and at {:.4g} m/s by {}, {:.1f} standard "
      "uncertainties apart, {:.1f} % in bulk modulus.",
      first.value, first.name, second.value, second.name,
      std::abs(second.value - first.value) / uncertainty,
      100.0 * (std::pow(first.value / second.value, 2) - 1.0));
}

std::string structural_bound_sentence(const FailedCheck& failed) {
  const io::StructureEntry& structure = failed.antenna.structure;
  return fmt::format(
      "'{}' is the lowest structural frequency predicted for the {} axis; it says nothing about "
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
      "With the motors held the plant of [structure] swings at {}, more than 5 % from what "
      "structure.prediction says: the modes' frequencies or inertia fractions are not those of the "
      "structural model{}.",
      fmt::join(apart, ", "),
      failed.antenna.structure.motors_held
          ? ""
          : ", or frequencies with the motors held stand where those with the bull gear held "
            "belong (structure.mode_frequencies)");
}

std::string structural_shares_sentence(const FailedCheck& failed) {
  const auto& entries = failed.check.entries;
  std::vector<std::string> shares;
  for (std::size_t i = 0; i + 1 < entries.size(); i += 2) {
    shares.push_back(fmt::format("a {} of {:.3g} on an inertia fraction of {:.3g}",
                                 entries[i].id.substr(entries[i].id.rfind('.') + 1),
                                 entries[i].value, entries[i + 1].value));
  }
  return fmt::format(
      "A mode of [structure] takes most of wind or beam with little of the inertia, {}: so soft a "
      "part bends the beam by {:.3g} mdeg from the encoder under the mean wind of {:.3g} m/s; with "
      "shares of wind and beam equal to those of the inertia it would be {:.3g} mdeg. Such bending "
      "decides the pointing error, and no loop sees it: take the shares from a structural model "
      "(structure.modes_file).",
      fmt::join(shares, " and "), failed["bending by the stated shares"] / millidegree,
      failed.antenna.wind.design_speed.value,
      failed["bending by the shares of the inertia"] / millidegree);
}

std::string motors_held_sentence(const FailedCheck& failed) {
  const auto& springs = failed.check.numbers;
  const auto antennas = io::structure_specifications(failed.antenna.structure);
  std::vector<std::string> others;
  for (std::size_t i = 1; i < antennas.size(); ++i) {
    others.push_back(fmt::format("{:.3g} N.m/rad with {}, {}", springs.at(i).value,
                                 held_frequencies(antennas[i]), effective_fractions(antennas[i])));
  }
  return fmt::format(
      "{} antennas of these inertia fractions have the stated frequencies with the motors held; "
      "the studies take the one with the softest gear spring, {:.3g} N.m/rad at the motor shaft "
      "with modes at {} with the bull gear held, {}, and it may as well be {}: the effective "
      "inertia fractions of a structural model with the motors braked say which, and as "
      "effective_fraction in the place of inertia_fraction give that one alone; or the stiffness "
      "of gears and bearings does.",
      antennas.size(), springs.at(0).value, held_frequencies(antennas[0]),
      effective_fractions(antennas[0]), fmt::join(others, "; or "));
}

std::string gear_stiffness_sentence(const FailedCheck& failed) {
  const double stated = failed["stated"], own = failed["plant"];
  return fmt::format(
      "The gear train of structure.gear_stiffness has {:.4g} N.m/rad at the antenna's axis, the "
      "plant's gear spring there {:.4g} N.m/rad and is {:.3g} times as {}: it follows from "
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
      "[ensemble] is narrower than the case's own uncertainties (1 -+ sqrt(3) u): {}; shares of "
      "plants and robust designs leave out antennas that the case holds possible.",
      fmt::join(narrow, "; "));
}

std::string carrier_frequency_sentence(const FailedCheck& failed) {
  return fmt::format(
      "At '{}' the wave is {:.3g} m long against a dish of {:.3g} m: its beam would be {:.2g} deg "
      "wide and need no pointing.",
      failed.check.entries.at(0).text, failed["wavelength"],
      failed.antenna.antenna.dish_diameter.value, failed["beam width"] / degree);
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
    CheckWording{"structural_shares", "structural shares", &structural_shares_sentence},
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
