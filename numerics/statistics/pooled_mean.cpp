#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/pooled_mean.hpp>

namespace boresight::numerics {

double PooledMean::reduced_chi_squared() const {
  return degrees_of_freedom > 0 ? heterogeneity / degrees_of_freedom : 0.0;
}

PooledMean pooled_mean(const std::vector<Uncertain>& estimates) {
  if (estimates.empty()) {
    throw InvalidInput("pooled_mean: expected at least one estimate, found none");
  }
  double weight = 0.0, weighted = 0.0, squares = 0.0;
  for (const auto& estimate : estimates) {
    const double u = estimate.standard_uncertainty;
    if (!(u > 0.0) || !std::isfinite(u) || !std::isfinite(estimate.value)) {
      throw InvalidInput(fmt::format(
          "pooled_mean: expected finite estimates with positive uncertainties, found {} +- {}",
          estimate.value, u));
    }
    const double own = 1.0 / (u * u);
    weight += own;
    weighted += own * estimate.value;
    squares += own * own;
  }
  const double fixed_mean = weighted / weight;
  PooledMean pooled;
  for (const auto& estimate : estimates) {
    pooled.heterogeneity +=
        std::pow((estimate.value - fixed_mean) / estimate.standard_uncertainty, 2);
  }
  pooled.degrees_of_freedom = static_cast<int>(estimates.size()) - 1;
  const double excess = pooled.heterogeneity - pooled.degrees_of_freedom;
  const double variance =
      pooled.degrees_of_freedom > 0 ? std::max(0.0, excess / (weight - squares / weight)) : 0.0;
  pooled.between = std::sqrt(variance);
  double total = 0.0;
  pooled.mean.value = 0.0;
  for (const auto& estimate : estimates) {
    const double own = 1.0 / (std::pow(estimate.standard_uncertainty, 2) + variance);
    total += own;
    pooled.mean.value += own * estimate.value;
  }
  pooled.mean.value /= total;
  pooled.mean.standard_uncertainty = 1.0 / std::sqrt(total);
  return pooled;
}

}  // namespace boresight::numerics
