#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace boresight::identification {

/// A maximum of a spectrum.
struct SpectralPeak {
  double frequency = 0.0;        // Hz, between bins
  double height = 0.0;           // in the spectrum's unit
  double over_background = 0.0;  // height over the median about it
  /// Half width by half power: the damping ratio of a lightly damped resonance that the
  /// spectrum's resolution does not widen; nothing where a neighbour hides a flank.
  std::optional<double> half_power_damping;
  /// Number of the excitation's harmonic it lies on; 0: on none.
  int harmonic = 0;
  /// Distance from that harmonic, or from the nearest one, Hz. 0 without a period.
  double from_harmonic = 0.0;
};

struct PeakOptions {
  double lowest = 0.0;   // Hz
  double highest = 0.0;  // Hz; 0: to the spectrum's end
  /// A peak stands this far above the median of the spectrum about it ...
  double min_over_background = 3.0;
  /// ... over this many bins to each side.
  Eigen::Index background_bins = 40;
};

/// Maxima of a spectrum of power (or of power density) at evenly spaced frequencies, highest first;
/// place and height by the parabola through the logarithms of three bins (a Gaussian's exact
/// maximum; with Hann's window a sine's to 0.02 bins without padding).
/// @throws InvalidInput for fewer than 5 bins, negative or not finite power, frequencies not evenly
/// rising.
std::vector<SpectralPeak> spectral_peaks(const Eigen::VectorXd& frequency,
                                         const Eigen::VectorXd& power,
                                         const PeakOptions& options = {});

/// Marks the peaks that lie on a harmonic n/period of a periodic excitation, within `tolerance`
/// (Hz). A peak so marked is no evidence of a resonance: it is where the excitation is.
/// @throws InvalidInput for a period or a tolerance that is not positive.
void label_harmonics(std::vector<SpectralPeak>& peaks, double period, double tolerance);

/// Period (s) of a signal that repeats itself at least twice in the record: the first of the
/// highest maxima of its autocorrelation, refined at the last repetition in the record. Nothing
/// where no shift correlates with more than `min_correlation`.
/// @throws InvalidInput for fewer than 16 samples, not finite ones or a sample time not positive.
std::optional<double> repetition_period(const Eigen::VectorXd& signal, double sample_time,
                                        double min_correlation = 0.6);

}  // namespace boresight::identification
