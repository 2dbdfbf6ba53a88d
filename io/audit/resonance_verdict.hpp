#pragma once

#include <optional>

#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::io {

/// The measured hydraulic frequency of a case against the resonating_mode of its flexible antenna.
struct ResonanceVerdict {
  /// Number of standard uncertainties beyond which the two contradict each other.
  static constexpr double contradicting_deviation = 3.0;
  double measured = 0.0;  // Hz
  double expected = 0.0;  // Hz, of the flexible antenna
  /// Standard uncertainty of their difference (Hz), to first order: of the reading, the oil
  /// stiffness, the inertias of motors and antenna and the structure's frequencies.
  double standard_uncertainty = 0.0;
  double stated_bulk_modulus = 0.0;  // Pa, of the case, or the mean over its lines
  /// Pa: bulk_modulus_for(measured).
  std::optional<double> bulk_modulus = std::nullopt;
  /// Oil stiffness over the ensemble (member_ranges) on which controllers are evaluated, as factors
  /// on the case's.
  double min_oil = 1.0, max_oil = 1.0;
  bool of_oil = false;  // of the mode with most oil, as the case says
  bool rigid = true;    // rings_as_rigid: an inertia may be computed from it
  /// The expected one, and plant::mode_of_oil.
  plant::PlantMode mode = {}, oil_mode = {};

  /// Difference of the two in standard uncertainties.
  double deviation() const;
  /// Whether that is more than contradicting_deviation.
  bool contradicts() const;
};

/// Effective bulk modulus of the oil (Pa) at which the resonating_mode of the case's flexible
/// antenna has that frequency (Hz). All else is as in the case; the leakage rate is that of
/// leakage_rate_at. Of several solutions the nearest; nothing if there is none within a factor of
/// 30 of the case's value.
std::optional<double> bulk_modulus_for(const Case& antenna, double frequency);

/// Nothing for a case without a measured frequency.
std::optional<ResonanceVerdict> resonance_verdict(const Case& antenna);
/// The same of an antenna as stated; none where records show the drive.
std::optional<ResonanceVerdict> resonance_verdict(const DesignedAntenna& designed);

}  // namespace boresight::io
