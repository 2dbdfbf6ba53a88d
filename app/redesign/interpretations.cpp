#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/redesign/interpretations.hpp>
#include <boresight/io/audit/antenna_readings.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {
namespace {

using io::AntennaReading;
using io::ReadingKind;

constexpr double gigapascal = 1e9;  // Pa

constexpr std::string_view of_rigid_masses = "rigid-body resonance; ";

std::string oil_text(const io::Case& antenna, const AntennaReading& reading) {
  return fmt::format(
      "bulk modulus of {:.3g} GPa{} for which the flexible antenna resonates at the measured {:g} "
      "Hz",
      reading.bulk_modulus / gigapascal,
      antenna.drive->leakage_by_flow ? ", and the leakage rate with it," : ",",
      reading.wanted_frequency.value_or(0.0));
}

std::string stiffness_text(const io::Case& antenna, const AntennaReading& reading) {
  const double factor = reading.factor;
  return fmt::format(
      "oil spring {} by a factor of {:.3g}{} so that the rigid masses resonate at {:g} Hz",
      factor < 1.0 ? "lowered" : "raised", std::max(factor, 1.0 / factor),
      antenna.drive->leakage_by_flow ? ", and the leakage rate with it," : "",
      reading.wanted_frequency.value_or(0.0));
}

// `model`: what the test's formula takes the antenna for.
std::string tested_text(std::string_view model, const io::TestedInertia& tested) {
  return fmt::format(
      "{}motor and gear inertia fixed; antenna inertia {:.3f} kg.m2 instead of {:.3f}", model,
      tested.left(), tested.stated);
}

std::string fractions_text(io::GuessedFractions fractions) {
  return fmt::format(
      "assumed wind and boresight fractions, of the rest beside stated and negative ones, {}",
      fractions == io::GuessedFractions::as_inertia
          ? "in proportion to the inertia fractions"
          : "all on the bull gear or mode of largest inertia, as for a dish on its support");
}

// What it takes from where.
std::string reading_text(const io::Case& antenna, const AntennaReading& reading) {
  switch (reading.kind) {
    case ReadingKind::as_stated:
      return "masses and oil stiffness of the plant above";
    case ReadingKind::other_inertia:
      return reading.other_attitude ? "another antenna inertia on the same springs"
                                    : "another antenna inertia";
    case ReadingKind::oil_convention:
      return "the other convention for the oil spring";
    case ReadingKind::gear_spring:
      return "another antenna with the same motors-locked frequencies";
    case ReadingKind::guessed_fractions:
      return fractions_text(reading.fractions);
    case ReadingKind::oil_by_resonance:
      return oil_text(antenna, reading);
    case ReadingKind::stiffness_by_resonance:
      return stiffness_text(antenna, reading);
    case ReadingKind::inertia_by_resonance:
      return tested_text(of_rigid_masses, reading.tested.value());
    case ReadingKind::masses_by_resonance:
      return fmt::format("{}every inertia times {:.3f}", of_rigid_masses, reading.factor);
    case ReadingKind::inertia_by_impulse:
      return tested_text("", reading.tested.value());
  }
  return "";
}

std::string impossible_text(const AntennaReading& reading) {
  if (reading.antenna || !reading.tested) return "";
  const io::TestedInertia& tested = *reading.tested;
  return fmt::format("{:.3f} - {:.3f} leaves {:.3f} kg.m2 for an antenna of {:.3f}", tested.found,
                     tested.fixed, tested.left(), tested.stated);
}

}  // namespace

std::vector<PlantInterpretation> plant_interpretations(const io::Case& antenna) {
  std::vector<PlantInterpretation> interpretations;
  for (auto& reading : antenna_readings(antenna)) {
    InterpretationResult result;
    result.says = reading_text(antenna, reading);
    result.impossible = impossible_text(reading);
    result.name = reading.name;
    result.oil_stiffness = reading.oil_stiffness;
    result.reflected_inertia = reading.reflected_inertia;
    result.motor_to_load_ratio = reading.motor_to_load_ratio;
    result.other_fractions = reading.other_fractions;
    result.other_attitude = reading.other_attitude;
    result.contradicts = reading.contradicts;
    result.wanted_frequency = reading.wanted_frequency;
    result.resonance = reading.resonance;
    interpretations.push_back({std::move(result), std::move(reading.antenna)});
  }
  return interpretations;
}

}  // namespace boresight::app
