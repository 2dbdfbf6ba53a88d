#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/math/special_functions/beta.hpp>
#include <fmt/format.h>

#include <boresight/design/ensembles/monte_carlo_statistics.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using numerics::normal_975;
constexpr double tail = 0.025;

EstimatedNumber about(double value, double standard_error) {
  return {value, value - normal_975 * standard_error, value + normal_975 * standard_error};
}

// The interval of a quantile between order statistics of sorted values.
EstimatedNumber quantile(const std::vector<double>& sorted, double fraction) {
  EstimatedNumber number{numerics::quantile(sorted, fraction), -infinity, infinity};
  const auto lower = numerics::rank_below_quantile(sorted.size(), fraction, tail);
  const auto upper = numerics::rank_below_quantile(sorted.size(), 1.0 - fraction, tail);
  if (lower >= 0) number.lower = sorted[static_cast<std::size_t>(lower)];
  if (upper >= 0) number.upper = sorted[sorted.size() - 1 - static_cast<std::size_t>(upper)];
  return number;
}

// From 1, ties at their mean.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t i, std::size_t j) {
    return values[i] < values[j] || (values[i] == values[j] && i < j);
  });
  std::vector<double> rank(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double mean = 0.5 * static_cast<double>(first + 1 + end);
    for (std::size_t k = first; k < end; ++k) rank[order[k]] = mean;
    first = end;
  }
  return rank;
}

}  // namespace

DistributionSummary summarise(std::vector<double> values, const std::vector<double>& fractions) {
  for (const double fraction : fractions) {
    if (!(fraction > 0.0) || !(fraction < 1.0)) {
      throw InvalidInput(
          fmt::format("summarise: expected fractions within (0, 1), found {:g}", fraction));
    }
  }
  for (const double value : values) {
    if (!std::isfinite(value)) {
      throw InvalidInput(fmt::format("summarise: expected finite values, found {}", value));
    }
  }
  std::ranges::sort(values);
  DistributionSummary summary;
  summary.random_samples = values.size();
  const EstimatedNumber unknown{nan, nan, nan};
  if (values.empty()) {
    summary.mean = summary.standard_deviation = unknown;
    summary.minimum = summary.largest = nan;
    for (const double fraction : fractions) summary.quantiles.push_back({fraction, unknown});
    return summary;
  }
  const auto n = static_cast<double>(values.size());
  // About a value of their own, so that nothing cancels where all are nearly the same.
  const double origin = values[values.size() / 2];
  double sum = 0.0;
  for (const double value : values) sum += value - origin;
  const double mean = origin + sum / n;
  double square = 0.0, fourth = 0.0;
  for (const double value : values) {
    const double away = (value - mean) * (value - mean);
    square += away;
    fourth += away * away;
  }
  summary.minimum = values.front();
  summary.largest = values.back();
  if (values.size() < 2) {
    summary.mean = {mean, -infinity, infinity};
    summary.standard_deviation = unknown;
  } else {
    const double variance = square / (n - 1.0), deviation = std::sqrt(variance);
    summary.mean = about(mean, deviation / std::sqrt(n));
    const double spread = std::max(0.0, fourth / n - variance * variance);
    const double error = deviation > 0.0 ? 0.5 * std::sqrt(spread / n) / deviation : 0.0;
    summary.standard_deviation = about(deviation, error);
    summary.standard_deviation.lower = std::max(0.0, summary.standard_deviation.lower);
  }
  for (const double fraction : fractions)
    summary.quantiles.push_back({fraction, quantile(values, fraction)});
  return summary;
}

EstimatedNumber probability(std::uint64_t hits, std::uint64_t random_samples) {
  if (hits > random_samples) {
    throw InvalidInput(
        fmt::format("probability: expected at most {} hits, found {}", random_samples, hits));
  }
  if (random_samples == 0) return {nan, 0.0, 1.0};
  const auto k = static_cast<double>(hits), n = static_cast<double>(random_samples);
  return {k / n, hits == 0 ? 0.0 : boost::math::ibeta_inv(k, n - k + 1.0, tail),
          hits == random_samples ? 1.0 : boost::math::ibetac_inv(k + 1.0, n - k, tail)};
}

EstimatedNumber rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size()) {
    throw InvalidInput(fmt::format(
        "rank_correlation: expected as many values of both, found {} and {}", x.size(), y.size()));
  }
  constexpr std::size_t minimum = 10;
  if (x.size() < minimum) return {nan, nan, nan};
  const auto rank_x = ranks(x), rank_y = ranks(y);
  const double middle = 0.5 * (static_cast<double>(x.size()) + 1.0);
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = rank_x[i] - middle, dy = rank_y[i] - middle;
    xx += dx * dx;
    yy += dy * dy;
    xy += dx * dy;
  }
  if (!(xx > 0.0) || !(yy > 0.0)) return {nan, nan, nan};
  const double rho = std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
  if (std::abs(rho) == 1.0) return {rho, rho, rho};
  const double error = std::sqrt((1.0 + 0.5 * rho * rho) / (static_cast<double>(x.size()) - 3.0));
  const auto within = about(std::atanh(rho), error);
  return {rho, std::tanh(within.lower), std::tanh(within.upper)};
}

}  // namespace boresight::design
