#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/commissioning/ratio_band.hpp>

namespace boresight::design {

/// A recorded channel.
struct RecordedChannel {
  Eigen::VectorXd values;    // evenly sampled, any unit
  std::vector<bool> valid;   // one per sample, or empty: all
  double sample_time = 0.0;  // s
};

struct RecordComparisonOptions {
  /// Band edges (Hz), rising; empty: octaves, see compare_records.
  std::vector<double> edges = {};
  double confidence = 0.95;
};

enum class Change {
  none,    // the interval of the ratio contains 1
  better,  // the interval lies below 1
  worse,   // the interval lies above 1
};
std::string_view to_string(Change change);
Change change_of(const RatioBand& ratio);

/// Mean squares of two records in one band, about their means.
struct BandComparison {
  double lowest = 0.0, highest = 0.0;  // Hz
  double rms_before = 0.0, rms_after = 0.0;
  /// Equivalent degrees of freedom of the two mean squares.
  double freedom_before = 0.0, freedom_after = 0.0;
  /// rms after over before, and its interval.
  double ratio = 0.0, lower = 0.0, upper = 0.0;
  Change change = Change::none;
};

struct RecordComparison {
  BandComparison whole;  // over all frequencies compared
  std::vector<BandComparison> bands;
  /// One-sided densities (per Hz) at frequencies (Hz) that both have.
  std::vector<double> frequency, density_before, density_after;
};

/// Compares one channel of two records, assumed stationary Gaussian noise under the same
/// disturbance. Spectra are by P. D. Welch's method (identification/signals/spectrum.hpp), with
/// segments of an eighth of the shorter record under Hann's window, a straight line removed from
/// each. A band's mean square has
///   freedom = 2 averages (sum S)^2 / sum over bins k, l of S_k S_l r(k - l)^2
/// degrees of freedom, where r is the correlation of neighbouring bins by the window (J. S. Bendat,
/// A. G. Piersol, Random Data, 4th ed., 8.5). A line or a slow drift therefore counts as few
/// independent samples. The ratio of two independent mean squares of equal expectation has Fisher's
/// F distribution, which gives the interval of the ratio of rms. Bands: octaves down from the lower
/// of the two half sampling rates, to the lowest that contains 3 bins.
/// @throws InvalidInput for values that are not finite, a mask of another length, edges that do not
/// rise or leave no bin, fewer than 64 samples, sampling times that are not positive, a confidence
/// outside (0, 1), or a constant record; NumericalFailure if no segment is free of invalid samples.
RecordComparison compare_records(const RecordedChannel& before, const RecordedChannel& after,
                                 const RecordComparisonOptions& options = {});

}  // namespace boresight::design
