#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/guessed_shares.hpp>
#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::io {

/// What the numbers of a case are read as.
enum class ReadingKind {
  as_stated,               // the case's own antenna
  other_inertia,           // of an alternative
  oil_convention,          // the other convention for the oil spring
  gear_spring,             // another antenna of the frequencies stated with the motors held
  guessed_shares,          // another place of the guessed shares of wind and beam
  oil_by_resonance,        // the bulk modulus by which the flexible antenna resonates as measured
  stiffness_by_resonance,  // the oil spring by which the rigid masses do
  inertia_by_resonance,    // the inertia that does on the oil spring
  masses_by_resonance,     // the same, every inertia scaled
  inertia_by_impulse,      // the inertia that an impulse test found
};

/// An inertia at the motor shaft by a test, kg m2: what motors and gear train leave of it is the
/// antenna's.
struct TestedInertia {
  double found = 0.0, fixed = 0.0;
  double stated = 0.0;  // of the antenna, as the case has it
  double left() const { return found - fixed; }
};

/// An antenna that the numbers of a case may mean.
struct AntennaReading {
  ReadingKind kind = ReadingKind::as_stated;
  std::string name;                       // one of its own, for results
  std::optional<plant::Antenna> antenna;  // none where a test leaves less than 5 % of the stated
  double oil_stiffness = 0.0;             // N m/rad
  double reflected_inertia = 0.0;         // kg m2, of the whole
  double motor_to_load_ratio = 0.0;
  /// Another source's number or a test's result beside the stated one, not a convention.
  bool contradicts = false;
  bool other_attitude = false;  // of the same antenna, on its own springs
  bool other_shares = false;    // another guess of the shares of wind and beam
  /// Hz: the resonating_mode of its flexible antenna, 0 where the case has no measured one; and of
  /// readings by resonance the measured one that they are made for.
  double resonance = 0.0;
  std::optional<double> wanted_frequency;

  /// What the kind says more of.
  double bulk_modulus = 0.0;  // Pa: oil_by_resonance
  double factor = 1.0;        // on the oil spring or on every inertia: the two by resonance
  GuessedShares shares = GuessedShares::as_stated;
  std::optional<TestedInertia> tested;
};

/// The case's own antenna first, then what else its numbers may mean: other antenna inertias, the
/// other convention for the oil spring, other antennas of the frequencies stated with the motors
/// held, other places of the guessed shares of wind and beam (GuessedShares), and what resonance
/// and impulses say of oil spring or inertia: the resonance of the flexible antenna
/// (bulk_modulus_for) first, then of rigid masses.
/// @throws InvalidInput as antennas_of and plant::linear_plant; NumericalFailure as
/// resonating_mode.
std::vector<AntennaReading> antenna_readings(const Case& antenna);

}  // namespace boresight::io
