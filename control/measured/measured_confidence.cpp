#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/measured/measured_confidence.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

// At 1 a circle of errors reaches -1.
constexpr double largest_error = 0.7;

}  // namespace

double confidence_radius(double confidence, double degrees_of_freedom) {
  if (!(confidence >= 0.0) || !(confidence < 1.0) || !(degrees_of_freedom >= 0.0)) {
    throw InvalidInput(
        fmt::format("confidence_radius: expected a confidence from 0 to below 1 and no negative "
                    "degrees of freedom, found {} and {}",
                    confidence, degrees_of_freedom));
  }
  const double exponent = -std::log1p(-confidence);
  if (degrees_of_freedom == 0.0) return std::sqrt(exponent);
  return std::sqrt(degrees_of_freedom * std::expm1(exponent / degrees_of_freedom));
}

MeasuredLoopPoint measured_loop_point(const MeasuredChannels& channels,
                                      const Controller& controller, double delay,
                                      LoopBreak loop_break, double frequency) {
  const plant::ResponsePoint response = channels.at(frequency);
  const CompensatorResponse c = compensator_response(controller, frequency);
  const Complex dead_time = std::polar(1.0, -frequency * delay);
  const Complex rate_return =
      1.0 + loop_gain(response, frequency, controller, delay, LoopBreak::rate_loop_alone);
  const Complex both_return =
      1.0 + loop_gain(response, frequency, controller, delay, LoopBreak::valve_command);
  const Complex angle = c.rate * c.position;
  // Derivatives of both returns by tachometer, torque and encoder per command.
  const Eigen::RowVector3cd rate = Eigen::RowVector3cd{c.rate, c.pressure, 0.0} * dead_time;
  const Eigen::RowVector3cd both =
      Eigen::RowVector3cd{c.rate, c.pressure - angle * c.compliance, angle} * dead_time;
  MeasuredLoopPoint point;
  point.loop_gain = loop_gain(response, frequency, controller, delay, loop_break);
  switch (loop_break) {
    case LoopBreak::rate_loop_alone:
      point.log_sensitivity = -rate / rate_return;
      break;
    case LoopBreak::valve_command:
      point.log_sensitivity = -both / both_return;
      break;
    case LoopBreak::position_loop:
      point.log_sensitivity = rate / rate_return - both / both_return;
      break;
  }
  const Complex variance =
      point.log_sensitivity * channels.covariance(frequency) * point.log_sensitivity.adjoint();
  point.relative_error = std::sqrt(std::max(variance.real(), 0.0));
  return point;
}

LoopChannels least_favourable(const MeasuredChannels& channels, const Controller& controller,
                              double delay, LoopBreak loop_break, double radius,
                              const Eigen::ArrayXd& grid) {
  return sampled_on(grid, [channels, controller, delay, loop_break, radius](double w) {
    const MeasuredLoopPoint loop = measured_loop_point(channels, controller, delay, loop_break, w);
    if (!(loop.relative_error > 0.0)) return channels.at(w);
    const double length =
        std::min(radius, largest_error / loop.relative_error) / loop.relative_error;
    return channels.changed(w, channels.covariance(w) * loop.log_sensitivity.adjoint() * length);
  });
}

}  // namespace boresight::control
