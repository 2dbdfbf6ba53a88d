#pragma once

#include <boresight/design/commissioning/ratio_band.hpp>
#include <boresight/identification/signals/spectrum.hpp>

namespace boresight::design {

/// Mean square of a channel between two frequencies.
struct BandPower {
  double mean_square = 0.0;
  /// Equivalent degrees of freedom, see compare_records; 0 without power.
  double freedom = 0.0;
  int bins = 0;
};

/// Of a channel of spectra under Hann's window, over the bins from `from` up to but not including
/// `to` (Hz), without the mean.
BandPower band_power(const identification::SpectralMatrix& matrix, Eigen::Index channel,
                     double from, double to);

/// Root of the ratio of two independent mean squares, `after` over `before`, with its interval by
/// Fisher's F. Both mean squares must be positive. @throws InvalidInput as numerics::f_quantile.
RatioBand rms_ratio(const BandPower& before, const BandPower& after, double confidence);

/// Root of a positive mean square, with its interval by chi-squared.
RmsBand rms_interval(const BandPower& power, double confidence);

}  // namespace boresight::design
