#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/case/guessed_fractions.hpp>
#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::io {

/// An interpretation of a case's numbers.
enum class ReadingKind {
  as_stated,               // the case's own antenna
  other_inertia,           // by an alternative antenna inertia
  oil_convention,          // the other convention for the oil spring
  gear_spring,             // another antenna with the frequencies stated for locked motors
  guessed_fractions,       // other values of the assumed wind fractions and beam weights
  oil_by_resonance,        // bulk modulus that reproduces the resonance, flexible antenna
  stiffness_by_resonance,  // oil spring that reproduces it, rigid masses
  inertia_by_resonance,    // inertia that reproduces it on the stated oil spring
  masses_by_resonance,     // the same, every inertia scaled
  inertia_by_impulse,      // the inertia found by an impulse test
};

/// An inertia (kg m2) at the motor shaft found by a test. The antenna's part is what remains after
/// subtracting motors and gear train.
struct TestedInertia {
  double found = 0.0, fixed = 0.0;
  double stated = 0.0;  // of the antenna, as the case has it
  double left() const { return found - fixed; }
};

/// One alternative interpretation of the case's antenna.
struct AntennaReading {
  ReadingKind kind = ReadingKind::as_stated;
  std::string name;                       // unique, for results
  std::optional<plant::Antenna> antenna;  // none where a test leaves less than 5 % of the stated
  double oil_stiffness = 0.0;             // N m/rad
  double reflected_inertia = 0.0;         // kg m2, of the whole
  double motor_to_load_ratio = 0.0;
  /// True for another source's number or a test's result that contradicts the stated one; false for
  /// a convention.
  bool contradicts = false;
  bool other_attitude = false;   // of the same antenna, on its own springs
  bool other_fractions = false;  // other assumed wind fractions and beam weights
  /// Resonance of its flexible antenna (resonating_mode, Hz); 0 if the case has no measured one.
  /// For interpretations by resonance, wanted_frequency is the measured frequency to reproduce.
  double resonance = 0.0;
  std::optional<double> wanted_frequency;

  /// Further data, by kind.
  double bulk_modulus = 0.0;  // Pa: oil_by_resonance
  double factor = 1.0;        // on the oil spring or on every inertia, for the two by resonance
  GuessedFractions fractions = GuessedFractions::as_stated;
  std::optional<TestedInertia> tested;
};

/// The case's own antenna first, then its alternative interpretations. They have other antenna
/// inertias, the other convention for the oil spring, or other antennas with the frequencies stated
/// for locked motors. Further ones have other assumed wind fractions and beam weights
/// (GuessedFractions). The last ones have the oil spring or inertia that resonance and impulses
/// give: by the flexible antenna (bulk_modulus_for) first, then by rigid masses.
/// @throws InvalidInput as antennas_of and plant::linear_plant; NumericalFailure as
/// resonating_mode.
std::vector<AntennaReading> antenna_readings(const Case& antenna);

}  // namespace boresight::io
