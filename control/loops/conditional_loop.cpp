#include <boresight/control/loops/conditional_loop.hpp>
#include <boresight/control/loops/loop_point.hpp>

namespace boresight::control {

std::complex<double> conditional_loop_gain(const plant::ResponsePoint& response, double frequency,
                                           const Controller& controller, double delay) {
  const Controller held = without_conditional_integral(controller);
  const double corner = conditional_integral(controller)->corner;
  const LoopPoint point = loop_point(response, held, frequency, delay);
  const std::complex<double> integral = corner / std::complex<double>(0.0, frequency);
  return integral * (point.both_return - point.rate_return) / point.both_return;
}

}  // namespace boresight::control
