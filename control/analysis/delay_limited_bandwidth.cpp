#include <cmath>
#include <cstdint>
#include <numbers>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <boresight/control/analysis/delay_limited_bandwidth.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

template <typename Function>
double root(Function function, double lower, double upper) {
  std::uintmax_t iterations = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      function, lower, upper, boost::math::tools::eps_tolerance<double>(50), iterations);
  return 0.5 * (low + high);
}

}  // namespace

double delay_limited_bandwidth(double delay, double sensitivity_peak) {
  if (!(delay > 0.0) || !std::isfinite(delay) || !(sensitivity_peak > 1.0) ||
      !std::isfinite(sensitivity_peak)) {
    throw InvalidInput(fmt::format(
        "delay_limited_bandwidth: expected a delay above 0 and a sensitivity peak above "
        "1, found {:g} s, {:g}",
        delay, sensitivity_peak));
  }
  constexpr double quarter = 0.5 * std::numbers::pi;
  const double peak =
      root([&](double y) { return std::cos(y) * std::hypot(1.0, y) - 1.0 / sensitivity_peak; }, 0.0,
           quarter);
  const double gain = peak * (std::sin(peak) - peak * std::cos(peak));
  const double place =
      root([&](double y) { return y * (std::sin(y) + std::hypot(1.0, std::sin(y))) - gain; }, 0.0,
           quarter);
  return place / delay;
}

}  // namespace boresight::control
