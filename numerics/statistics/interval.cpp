#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/interval.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::numerics {

Interval interval_from_samples(double value, Eigen::VectorXd random_samples) {
  if (random_samples.size() < 20 || !random_samples.allFinite()) {
    throw InvalidInput(
        fmt::format("interval_from_samples: expected at least 20 finite samples, found {}{}",
                    random_samples.size(), random_samples.allFinite() ? "" : ", not all finite"));
  }
  const double mean = random_samples.mean();
  const double deviation = std::sqrt((random_samples.array() - mean).square().sum() /
                                     static_cast<double>(random_samples.size() - 1));
  std::sort(random_samples.begin(), random_samples.end());
  const std::span<const double> rising(random_samples.data(),
                                       static_cast<std::size_t>(random_samples.size()));
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
