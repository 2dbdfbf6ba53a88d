#pragma once

#include <cstddef>
#include <functional>

#include <boresight/plant/modal/modal_response.hpp>

namespace boresight::control {

/// Root mean square of a response to noise, by integrating its spectrum over all frequencies.
struct SpectralRms {
  double rms = 0.0;
  /// Estimate of the relative error of `rms`, from the nested quadrature rules and the tails.
  double relative_error = 0.0;
  std::size_t evaluations = 0;  // number of frequencies evaluated
  bool converged = false;       // relative_error is within the tolerance
};

struct SpectralRmsOptions {
  double relative_tolerance = 1e-8;
  std::size_t max_evaluations = 200000;
  /// One-sided spectrum of the noise per Hz at a frequency in Hz, for noise not shaped by a filter
  /// within the system. Default: white noise of unit intensity, 2 per Hz.
  std::function<double(double)> spectrum = {};
};

/// Rms of the output for stationary noise at the input, O(modes) per frequency. For white noise of
/// unit intensity it is sqrt(1/pi integral |H(j w)|^2 dw), the H2 norm. Adaptive Gauss-Kronrod
/// quadrature (7, 15 points) in ln w. Panels are divided at every lightly damped pole of core and
/// modes that contributes, and all panels of a generation are evaluated together. The system must
/// be stable, which is not tested here.
/// @throws InvalidInput for a tolerance outside 1e-13..0.1; NumericalFailure if the output has no
/// finite rms: a response that does not fall off towards infinite frequency, or one that is not
/// finite.
SpectralRms spectral_rms(const plant::ModalResponse& response,
                         const SpectralRmsOptions& options = {});

}  // namespace boresight::control
