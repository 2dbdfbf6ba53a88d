#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// A rational filter that makes a torque of a given spectrum from unit white noise:
///   G(s) = gain prod(1 + s/zero_i) / prod(1 + s/pole_i),   one-sided spectrum 2 |G|^2 per Hz,
/// real zeros and poles (rad/s), one zero fewer than poles.
struct ShapingFilter {
  double gain = 0.0;
  std::vector<double> zeros;
  std::vector<double> poles;
  /// Largest |ln(2 |G|^2 / S)| over the fitted points.
  double worst_log_error = 0.0;
};

/// Fits a filter of `order` poles to spectrum values (per Hz, one-sided, all > 0) at frequencies
/// (Hz), least squares in the logarithm of the spectrum by Levenberg-Marquardt over the logarithms
/// of gain, zeros and poles, from staggered starts. Points are best spaced evenly in log f. Of the
/// wind torques' spectra (wind.hpp, 5e-4 .. 5 Hz) order 4 keeps the rms of a loop's error within
/// 0.5 % in the uniform and coherence models and 3 % in Vickery's, whose steep corner needs order
/// 6; that keeps all within 0.2 %.
/// @throws InvalidInput for fewer points than unknowns or values that are not positive.
ShapingFilter fit_shaping_filter(const Eigen::ArrayXd& frequency, const Eigen::ArrayXd& spectrum,
                                 int order);

/// 2 |G(j 2 pi f)|^2.
double filter_spectrum(const ShapingFilter& filter, double frequency);

/// The filter as first-order sections in cascade; input `white_noise`, output `output`.
StateSpace to_state_space(const ShapingFilter& filter, const std::string& output);

}  // namespace boresight::plant
