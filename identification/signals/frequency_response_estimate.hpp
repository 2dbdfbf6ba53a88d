#pragma once

#include <boresight/identification/signals/spectrum.hpp>

namespace boresight::identification {

enum class ResponseEstimator {
  h1,  // S_xy/S_xx: noise at the output only
  h2,  // S_yy/S_yx: noise at the input only
  hv   // noise at both, in a known ratio of powers (total least squares)
};

/// A frequency response from measured spectra, with its confidence.
struct FrequencyResponseEstimate {
  Eigen::VectorXd frequency;  // Hz
  Eigen::VectorXcd response;  // output per input
  Eigen::VectorXd coherence;
  /// Standard uncertainty of the magnitude over the magnitude, and of the phase in rad:
  /// sqrt((1 - coherence)/(2 coherence averages)) (Bendat and Piersol, Random Data, 4th ed.,
  /// 9.2.4). Infinity where there is no coherence or a single average.
  Eigen::VectorXd relative_uncertainty;
};

/// Response from channel `input` to channel `output` of the spectra. `noise_ratio` (hv only): power
/// of the output's noise over that of the input's, per the square of their units.
/// @throws InvalidInput for channels that the spectra do not have or a ratio that is not positive.
FrequencyResponseEstimate frequency_response_estimate(
    const SpectralMatrix& spectra, Eigen::Index input, Eigen::Index output,
    ResponseEstimator estimator = ResponseEstimator::h1, double noise_ratio = 1.0);

/// The same inside a loop or with noise at both: S_ry/S_rx with a reference r (the command) that is
/// uncorrelated with the noise. The uncertainty follows from the part of the output that the
/// response does not explain. The coherence is the smaller of the reference's with the two.
/// @throws as frequency_response_estimate.
FrequencyResponseEstimate referenced_response_estimate(const SpectralMatrix& spectra,
                                                       Eigen::Index reference, Eigen::Index input,
                                                       Eigen::Index output);

}  // namespace boresight::identification
