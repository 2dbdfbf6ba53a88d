#include <cmath>

#include <fmt/format.h>

#include <boresight/control/delay.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::control {

plant::StateSpace delay_approximant(double delay, int order, const std::string& input,
                                    const std::string& output) {
  if (!(delay > 0.0) || !std::isfinite(delay) || order < 1 || order > 16) {
    throw InvalidInput(fmt::format(
        "delay_approximant: expected a positive delay and an order of 1 to 16, found {} s, {}",
        delay, order));
  }
  plant::StateSpace system{Eigen::MatrixXd(order, order),
                           Eigen::MatrixXd(order, 1),
                           Eigen::MatrixXd(1, order),
                           Eigen::MatrixXd::Zero(1, 1),
                           {input},
                           {output},
                           {}};
  const auto sign = [](int power) { return power % 2 == 0 ? 1.0 : -1.0; };
  // Scaling state i by sqrt(2i + 1) makes A as symmetric in size as it can be.
  for (int i = 0; i < order; ++i) {
    const double row = std::sqrt(2.0 * i + 1.0);
    for (int j = 0; j < order; ++j) {
      const double column = std::sqrt(2.0 * j + 1.0);
      system.a(i, j) = row * column / delay * (i < j ? -1.0 : sign(i - j + 1));
    }
    system.b(i, 0) = row / delay * sign(i);
    system.c(0, i) = row;
    system.states.push_back(fmt::format("{}_delay_{}", output, i + 1));
  }
  return system;
}

}  // namespace boresight::control
