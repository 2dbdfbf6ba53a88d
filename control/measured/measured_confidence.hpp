#pragma once

#include <boresight/control/measured/measured_channels.hpp>

namespace boresight::control {

/// How far, in standard deviations, a complex error lies with a probability `confidence` at one
/// frequency: |e|^2/var is distributed as F(2, 2q) for q degrees of freedom behind var, exponential
/// for q = 0 (var known). @throws InvalidInput unless 0 <= confidence < 1.
double confidence_radius(double confidence, double degrees_of_freedom);

/// The open-loop gain at a break, and what it makes of errors: to first order
/// ln S changes by the row `log_sensitivity` times the errors of tachometer, torque and encoder per
/// command.
struct MeasuredLoopPoint {
  std::complex<double> loop_gain;  // L, S = 1/(1 + L)
  Eigen::RowVector3cd log_sensitivity;
  /// Standard deviation of S over |S|: sqrt(E|d ln S|^2), |dL/(1 + L)| in a simple loop.
  double relative_error = 0.0;
};
MeasuredLoopPoint measured_loop_point(const MeasuredChannels& channels, const ControlLaw& law,
                                      double delay, LoopBreak loop_break, double frequency);

/// The response within its confidence that makes a law's |S| at a break largest, frequency by
/// frequency: errors of `radius` standard deviations in the direction in which |S| rises most
/// (radius C g^H/sqrt(g C g^H), C the covariance, g = d ln S). At the valve, where L is linear in
/// the responses, |S| becomes |S|/(1 - radius relative_error), no other response within the
/// confidence has more. Where the radius times the relative error reaches 0.7 it is cut to that:
/// what a law that is far from good there is judged on stays smooth.
LoopChannels least_favourable(const MeasuredChannels& channels, const ControlLaw& law, double delay,
                              LoopBreak loop_break, double radius, const Eigen::ArrayXd& grid);

}  // namespace boresight::control
