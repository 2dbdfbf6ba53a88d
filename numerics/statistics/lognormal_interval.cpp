#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/lognormal_interval.hpp>

namespace boresight::numerics {

Interval lognormal_interval(double value, double relative_uncertainty) {
  if (!(value > 0.0) || !(relative_uncertainty >= 0.0) || !std::isfinite(relative_uncertainty)) {
    throw InvalidInput(fmt::format(
        "lognormal_interval: expected a positive value and a standard uncertainty from 0, found "
        "{} and {}",
        value, relative_uncertainty));
  }
  const double factor = std::exp(normal_975 * relative_uncertainty);
  return {value, value * relative_uncertainty, value / factor, value * factor};
}

}  // namespace boresight::numerics
