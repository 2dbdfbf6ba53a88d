#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::identification {

enum class SpectralWindow {
  rectangular,
  hann,
  flat_top  // amplitudes of sines to 0.1 % wherever between bins; resolution 3.8 bins
};

/// What is taken out of each segment before its window.
enum class Detrend { none, mean, line };

/// Takes it out of the values; a line by least squares. `values`: 2 or more for a line.
void remove_trend(Eigen::VectorXd& values, Detrend detrend);

struct SpectrumOptions {
  /// Samples; 0: the power of two nearest below a sixth of the record (the whole record for fewer
  /// than 384 samples).
  Eigen::Index segment_length = 0;
  double overlap = 0.5;  // 0 .. 0.9, fraction of a segment
  SpectralWindow window = SpectralWindow::hann;
  Detrend detrend = Detrend::mean;
};

/// Auto- and cross-spectral densities of several channels.
struct SpectralMatrix {
  Eigen::VectorXd frequency;  // Hz, 0 .. half the sampling rate
  /// One a frequency, channels x channels, Hermitian: (i, j) is the one-sided density, per Hz, of
  /// conj(X_i) X_j. A sine's power (half its amplitude squared) is its peak times the noise
  /// bandwidth.
  std::vector<Eigen::MatrixXcd> density;
  double sample_time = 0.0;      // s
  double noise_bandwidth = 0.0;  // Hz, equivalent, of the window
  Eigen::Index segments = 0;     // averaged
  Eigen::Index left_out = 0;     // segments with a sample that is not valid
  /// Independent segments that the averages are worth: overlapping ones are correlated (P. D.
  /// Welch, IEEE Trans. Audio Electroacoustics 15, 1967).
  double effective_averages = 0.0;

  Eigen::VectorXd auto_density(Eigen::Index channel) const;
  Eigen::VectorXcd cross_density(Eigen::Index from, Eigen::Index to) const;
  /// |S_ij|^2/(S_ii S_jj), 0 where a channel has no power. Of one segment it is 1 whatever the
  /// channels are.
  Eigen::VectorXd coherence(Eigen::Index from, Eigen::Index to) const;
};

/// Welch's averaged periodograms. `channels`: samples x channels, evenly spaced by `sample_time`
/// (s); `valid`: one a sample or empty (all valid): segments with any invalid sample are left out.
/// Mean square of white noise of variance v: density 2 v dt at every frequency but the first and
/// the last. O(N log segment) a channel.
/// @throws InvalidInput for no channel, samples that are not finite, a segment longer than the
/// record or shorter than 8 samples, an overlap outside 0 .. 0.9, a mask of another length;
/// NumericalFailure if no segment is free of invalid samples.
SpectralMatrix spectral_matrix(const Eigen::MatrixXd& channels, double sample_time,
                               const SpectrumOptions& options = {},
                               const std::vector<bool>& valid = {});

/// The window's samples (periodic form), 0 .. 1.
Eigen::VectorXd window_samples(SpectralWindow window, Eigen::Index samples);

}  // namespace boresight::identification
