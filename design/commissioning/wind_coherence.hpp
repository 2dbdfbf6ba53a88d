#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/commissioning/ratio_band.hpp>
#include <boresight/identification/signals/spectrum.hpp>

namespace boresight::design {

/// Spectra of one record, one element a bin above zero frequency, of wind (squared speed) and
/// error.
struct CoherentSpectra {
  Eigen::ArrayXd wind, error;
  Eigen::ArrayXcd cross;
  double averages = 0.0;
};

/// Of spectra with the channels wind and error, up to a number of bins.
CoherentSpectra coherent_spectra(const identification::SpectralMatrix& spectra, Eigen::Index bins);

/// Fraction of the errors' power that is coherent with the wind in all records together, reduced by
/// its bias, within 0 .. 1; and the value that incoherent records exceed with probability 5 %.
struct ExplainedPower {
  double fraction = 0.0, threshold = 0.0;
};
ExplainedPower explained_power(const std::vector<CoherentSpectra>& records);

/// Ratio of the rms of the coherent parts, after over before, both in the mean spectrum of the wind
/// of all records; see compare_in_wind. None with fewer than three records on a side, or without
/// significant coherence.
std::optional<RatioBand> coherent_ratio(const std::vector<CoherentSpectra>& before,
                                        const std::vector<CoherentSpectra>& after,
                                        double confidence);

}  // namespace boresight::design
