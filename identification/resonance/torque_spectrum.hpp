#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/identification/signals/spectral_peaks.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

struct TorqueSpectrumOptions {
  /// Hz, where the hydraulic mode is expected.
  double expected_frequency = 0.0;
  double lowest_fraction = 0.6;  // of it: the band in which the peak is chosen
  double highest_fraction = 1.6;
  /// A peak this near (relative) to a locked-rotor frequency is the structure's.
  double structural_tolerance = 0.08;
};

/// Spectrum of the summed torque of one ramp test, as Sommerville's Figs. 9 and 10.
struct TorqueSpectrum {
  std::string record;
  /// Of the excitation, s: from the command where it was recorded, else from the torque.
  std::optional<double> period;
  Eigen::VectorXd frequency;  // Hz
  Eigen::VectorXd amplitude;  // N m, of a sine there
  double resolution = 0.0;    // Hz, half-amplitude width of a sine
  /// All peaks up to the highest locked-rotor frequency or four times the expected one, by height
  /// times frequency: what turns an inertia through a triangle of speed is a square wave of torque,
  /// whose harmonics fall with their number.
  std::vector<SpectralPeak> peaks;
  /// The peak that the paper's procedure takes for the hydraulic mode, and what it is.
  std::optional<SpectralPeak> chosen;
  bool on_harmonic = false;
  /// True if the record has enough periods (about four) to separate a harmonic from its
  /// surroundings.
  bool harmonics_resolved = false;
  /// Hz, between harmonics that the excitation has about the chosen peak (odd ones only where the
  /// even ones are weak).
  double harmonic_spacing = 0.0;
  /// Hz: the harmonics whose height times frequency is within 0.6 of the chosen one's. Their
  /// envelope is all that shows a mode that they are denser than.
  double envelope_lowest = 0.0;
  double envelope_highest = 0.0;
  /// Hz, standard uncertainty of reading the mode from it: where it lies on a harmonic the mode may
  /// be anywhere in the envelope and a spacing beyond (uniform), else a sixth of the resolution.
  double reading_uncertainty = 0.0;
  std::vector<std::string> notes;
};

/// The paper's reading: amplitude spectrum of the torque (Hann's window over the record), peaks,
/// those near locked-rotor frequencies left out, harmonics of the excitation recognised; the peak
/// with the largest height times frequency in the band is chosen, if it stands out.
/// @throws InvalidInput for an expected frequency that is not positive, or a record shorter than
/// four periods of it.
TorqueSpectrum torque_spectrum(const DriveRecord& record, const DriveKnowledge& knowledge,
                               const TorqueSpectrumOptions& options);

}  // namespace boresight::identification
