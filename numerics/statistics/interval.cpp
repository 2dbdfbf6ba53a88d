#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/interval.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::numerics {

Interval interval_from_draws(double value, Eigen::VectorXd draws) {
  if (draws.size() < 20 || !draws.allFinite()) {
    throw InvalidInput(
        fmt::format("interval_from_draws: expected at least 20 finite draws, found {}{}",
                    draws.size(), draws.allFinite() ? "" : ", not all finite"));
  }
  const double mean = draws.mean();
  const double deviation =
      std::sqrt((draws.array() - mean).square().sum() / static_cast<double>(draws.size() - 1));
  std::sort(draws.begin(), draws.end());
  const std::span<const double> rising(draws.data(), static_cast<std::size_t>(draws.size()));
  return {value, deviation, quantile(rising, 0.025), quantile(rising, 0.975)};
}

Interval normal_interval(double value, double standard_uncertainty) {
  if (!(standard_uncertainty >= 0.0) || !std::isfinite(standard_uncertainty)) {
    throw InvalidInput(
        fmt::format("normal_interval: expected a finite uncertainty that is not negative, found {}",
                    standard_uncertainty));
  }
  return {value, standard_uncertainty, value - normal_975 * standard_uncertainty,
          value + normal_975 * standard_uncertainty};
}

}  // namespace boresight::numerics
