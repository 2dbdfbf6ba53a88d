#pragma once

#include <cstdint>
#include <functional>

#include <Eigen/Core>

namespace boresight::plant {

/// One-sided spectrum per Hz at a frequency above 0 in Hz; at least 0 and finite.
using Spectrum = std::function<double(double)>;

struct StationarySeriesOptions {
  /// Series that go on from their last sample to their first, to be repeated without a jump. The
  /// number of samples must then have the prime factors 2, 3 and 5 only.
  bool periodic = false;
};

/// Stationary Gaussian time series of mean 0 with a given spectrum, prepared once for any number of
/// seeds. A series is a sum of sinusoids at the multiples k df of df = 1/T' whose amplitudes and
/// phases are those of independent complex Gaussian coefficients, the power of each the integral of
/// the spectrum over its cell (k - 1/2) df .. (k + 1/2) df, by adaptive quadrature (1e-4 of it),
/// not the value at its middle: where the spectrum rises from one line to the next, bands of few
/// lines are right too. A peak far narrower than a cell may escape the quadrature, as it would any
/// rule. Computed by the inverse Fourier transform.
///
/// T' is the duration T of a periodic series. By default it is the first power of two of samples
/// that is at least 2 T, of which the first T are kept: start and end are then unrelated, as in a
/// record, and frequencies between 0 and 1/T are there as drift.
///
/// Every sample has the variance sum of the cells = integral of S from df/2 to fs/2, fs the
/// sampling rate: all of [1/T, fs/2], and below 1/T what is above 1/(2 T) in a periodic series and
/// above 1/(4 T) or less otherwise. Power below df/2 (the mean) and above fs/2 is left out, not
/// folded into the band. The mean square over a whole periodic series scatters from seed to seed
/// with the standard deviation sqrt(sum of the squared cells), about sqrt(integral of S^2 df/T).
///
/// Coefficient k depends on seed, stream and k only, so that a series of half the sample time and
/// the same duration (twice the samples) has the same content below the old fs/2.
class StationarySeries {
 public:
  /// `duration` and `sample_time` in s; the series has the nearest whole number of samples, 2 to
  /// 2^26. @throws InvalidInput for these, a periodic length with a large prime factor, and a
  /// spectrum that is negative or not finite somewhere, naming the frequency; NumericalFailure for
  /// one that varies too fast within the cells to be integrated (more than 64 values a cell).
  StationarySeries(const Spectrum& spectrum, double duration, double sample_time,
                   const StationarySeriesOptions& options = {});

  /// The series of a seed; streams of a seed are independent of each other.
  Eigen::VectorXd draw(std::uint64_t seed, std::uint64_t stream = 0) const;

  Eigen::Index samples() const { return samples_; }
  double sample_time() const { return sample_time_; }
  /// 1/T', Hz.
  double frequency_step() const;
  /// Power of each sinusoid k = 1, 2, ..; the variance of a sample is their sum.
  const Eigen::ArrayXd& line_powers() const { return line_powers_; }
  double variance() const { return line_powers_.sum(); }

 private:
  Eigen::Index samples_;
  Eigen::Index transform_samples_;
  double sample_time_;
  Eigen::ArrayXd line_powers_;
};

/// One series: StationarySeries(spectrum, duration, sample_time, options).draw(seed).
Eigen::VectorXd synthesise(const Spectrum& spectrum, double duration, double sample_time,
                           std::uint64_t seed, const StationarySeriesOptions& options = {});

}  // namespace boresight::plant
