#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/double_sampling.hpp>

namespace boresight::numerics {

Interval mean_by_double_sampling(const Eigen::VectorXd& y, const Eigen::VectorXd& x) {
  if (y.size() < 4 || x.size() < y.size() || !y.allFinite() || !x.allFinite()) {
    throw InvalidInput(fmt::format(
        "mean_by_double_sampling: expected at least 4 finite observations and as many of the "
        "auxiliary, found {} and {}{}",
        y.size(), x.size(), y.allFinite() && x.allFinite() ? "" : ", not all finite"));
  }
  const auto n = static_cast<double>(y.size());
  const auto beside = x.head(y.size());
  const Eigen::VectorXd dy = y.array() - y.mean();
  const Eigen::VectorXd dx = beside.array() - beside.mean();
  const double xx = dx.squaredNorm(), yy = dy.squaredNorm(), xy = dx.dot(dy);
  const double slope = xx > 0.0 ? xy / xx : 0.0;
  const double gap = xx > 0.0 ? x.mean() - beside.mean() : 0.0;
  const double residual = std::max(0.0, yy - slope * xy) / (n - 2.0);
  const double explained = std::max(0.0, yy / (n - 1.0) - residual);
  const double variance = residual / n * (1.0 + (xx > 0.0 ? n * gap * gap / xx : 0.0)) +
                          explained / static_cast<double>(x.size());
  Interval mean;
  mean.value = y.mean() + slope * gap;
  mean.standard_uncertainty = std::sqrt(variance);
  const double half = student_quantile(0.975, n - 2.0) * mean.standard_uncertainty;
  mean.lower = mean.value - half;
  mean.upper = mean.value + half;
  return mean;
}

}  // namespace boresight::numerics
