#pragma once

#include <boresight/control/measured/measured_channels.hpp>

namespace boresight::control {

/// Radius, in standard deviations, that a complex error stays within with probability `confidence`
/// at one frequency. |e|^2/var has the distribution F(2, 2q) for a variance with q degrees of
/// freedom, and is exponential for q = 0 (var known).
/// @throws InvalidInput unless 0 <= confidence < 1.
double confidence_radius(double confidence, double degrees_of_freedom);

/// The open-loop gain at a break and its sensitivity to errors. To first order ln S changes by the
/// row `log_sensitivity` times the errors of tachometer, torque and encoder per command.
struct MeasuredLoopPoint {
  std::complex<double> loop_gain;  // L, S = 1/(1 + L)
  Eigen::RowVector3cd log_sensitivity;
  /// Standard deviation of S over |S|: sqrt(E|d ln S|^2), |dL/(1 + L)| in a simple loop.
  double relative_error = 0.0;
};
MeasuredLoopPoint measured_loop_point(const MeasuredChannels& channels,
                                      const Controller& controller, double delay,
                                      LoopBreak loop_break, double frequency);

/// The response within its confidence region that maximises |S| of a controller at a break, at each
/// frequency. The errors are `radius` standard deviations in the direction of the steepest rise of
/// |S|: radius C g^H/sqrt(g C g^H), C the covariance, g = d ln S. At the valve, where L is linear
/// in the responses, |S| becomes |S|/(1 - radius relative_error), and no other response within the
/// confidence region has a larger one. The product of radius and relative error is limited to 0.7,
/// so that the evaluation of a controller far from its limits remains smooth.
LoopChannels least_favourable(const MeasuredChannels& channels, const Controller& controller,
                              double delay, LoopBreak loop_break, double radius,
                              const Eigen::ArrayXd& grid);

}  // namespace boresight::control
