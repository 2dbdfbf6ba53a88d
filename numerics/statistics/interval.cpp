#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::numerics {
namespace {

// Quantile of sorted numbers, straight between neighbours.
double quantile(const Eigen::VectorXd& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<Eigen::Index>(std::floor(place));
  const Eigen::Index above = std::min(below + 1, sorted.size() - 1);
  return sorted(below) + (place - std::floor(place)) * (sorted(above) - sorted(below));
}

}  // namespace

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
  return {value, deviation, quantile(draws, 0.025), quantile(draws, 0.975)};
}

Interval normal_interval(double value, double standard_uncertainty) {
  if (!(standard_uncertainty >= 0.0) || !std::isfinite(standard_uncertainty)) {
    throw InvalidInput(
        fmt::format("normal_interval: expected a finite uncertainty that is not negative, found {}",
                    standard_uncertainty));
  }
  constexpr double normal_95 = 1.959963984540054;
  return {value, standard_uncertainty, value - normal_95 * standard_uncertainty,
          value + normal_95 * standard_uncertainty};
}

}  // namespace boresight::numerics
