#include <cmath>

#include <fmt/format.h>

#include <boresight/control/controllers/delay.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>

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

PadeCoefficients pade_coefficients(double delay, int numerator_degree, int denominator_degree) {
  constexpr int highest = 16;
  const auto unusable = [](int order) { return order < 0 || order > highest; };
  if (!(delay > 0.0) || !std::isfinite(delay) || unusable(numerator_degree) ||
      unusable(denominator_degree) || numerator_degree + denominator_degree == 0) {
    throw InvalidInput(
        fmt::format("pade_coefficients: expected a positive delay and degrees of 0 to {}, not both "
                    "0, found {} s, {} and {}",
                    highest, delay, numerator_degree, denominator_degree));
  }
  const int sum = numerator_degree + denominator_degree;
  const auto polynomial = [&](int order, double step) {
    std::vector<double> ascending{1.0};
    for (int k = 0; k < order; ++k) {
      ascending.push_back(ascending.back() * step * (order - k) /
                          (static_cast<double>(sum - k) * (k + 1)));
    }
    return ascending;
  };
  return {polynomial(numerator_degree, -delay), polynomial(denominator_degree, delay)};
}

plant::StateSpace pade_approximant(double delay, int numerator_degree, int denominator_degree,
                                   const std::string& input, const std::string& output) {
  if (numerator_degree > denominator_degree) {
    throw InvalidInput(
        fmt::format("pade_approximant: expected no higher degree of the numerator (a proper "
                    "function), found {} over {}",
                    numerator_degree, denominator_degree));
  }
  pade_coefficients(delay, numerator_degree, denominator_degree);  // refuses what has no meaning
  // In units of the delay, in which no power of it over- or underflows.
  const auto [numerator, denominator] =
      pade_coefficients(1.0, numerator_degree, denominator_degree);
  auto system =
      plant::balanced(plant::rational(numerator, denominator, input, output, output + "_delay"));
  system.a /= delay;
  system.b /= delay;
  for (std::size_t i = 0; i < system.states.size(); ++i) {
    system.states[i] = fmt::format("{}_delay_{}", output, i + 1);
  }
  return system;
}

}  // namespace boresight::control
