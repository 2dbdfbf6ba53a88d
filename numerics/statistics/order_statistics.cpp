#include <algorithm>

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::numerics {

double median(std::vector<double> values) {
  if (values.empty()) throw InvalidInput("median: expected at least one value, found none");
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median(const Eigen::VectorXd& values) {
  return median(std::vector<double>(values.begin(), values.end()));
}

double quantile(std::span<const double> rising, double fraction) {
  if (rising.empty() || !(fraction >= 0.0) || !(fraction <= 1.0)) {
    throw InvalidInput(fmt::format(
        "quantile: expected at least one value and a fraction within [0, 1], found {} and "
        "{}",
        rising.size(), fraction));
  }
  const double place = fraction * static_cast<double>(rising.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double here = rising[below], above = rising[std::min(below + 1, rising.size() - 1)];
  const double part = place - static_cast<double>(below);
  return part > 0.0 && above > here ? here + part * (above - here) : here;
}

std::ptrdiff_t rank_below_quantile(std::size_t count, double fraction, double probability) {
  const boost::math::binomial_distribution<double> samples_below(static_cast<double>(count),
                                                                 fraction);
  // P(samples below <= low) <= probability < P(samples below <= high)
  std::ptrdiff_t low = -1, high = static_cast<std::ptrdiff_t>(count);
  while (high - low > 1) {
    const std::ptrdiff_t middle = low + (high - low) / 2;
    (boost::math::cdf(samples_below, static_cast<double>(middle)) <= probability ? low : high) =
        middle;
  }
  return low;
}

}  // namespace boresight::numerics
