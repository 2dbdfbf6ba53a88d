#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/figures/thinned_series.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {

ThinnedSeries thinned(const Eigen::VectorXd& x, const Eigen::VectorXd& y, std::size_t maximum) {
  if (x.size() != y.size() || maximum < 2) {
    throw InvalidInput(
        fmt::format("thinned: expected as many y as x and 2 points or more, found "
                    "{}, {} and {}",
                    x.size(), y.size(), maximum));
  }
  const auto count = static_cast<std::size_t>(x.size());
  ThinnedSeries series;
  if (count <= maximum) {
    series.x.assign(x.begin(), x.end());
    series.y.assign(y.begin(), y.end());
    return series;
  }
  const std::size_t stretches = maximum / 2;
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t begin = k * count / stretches, end = (k + 1) * count / stretches;
    std::size_t minimum = end, largest = end;
    for (std::size_t i = begin; i < end; ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (!std::isfinite(x[at]) || !std::isfinite(y[at])) continue;
      if (minimum == end || y[at] < y[static_cast<Eigen::Index>(minimum)]) minimum = i;
      if (largest == end || y[at] > y[static_cast<Eigen::Index>(largest)]) largest = i;
    }
    if (minimum == end) {
      series.x.push_back(x[static_cast<Eigen::Index>(begin)]);
      series.y.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const auto [first, second] = std::minmax(minimum, largest);
    for (const std::size_t i : {first, second}) {
      series.x.push_back(x[static_cast<Eigen::Index>(i)]);
      series.y.push_back(y[static_cast<Eigen::Index>(i)]);
      if (first == second) break;
    }
  }
  return series;
}

std::vector<double> plotted(const Eigen::VectorXd& values, double factor) {
  std::vector<double> list;
  list.reserve(static_cast<std::size_t>(values.size()));
  for (const double value : values) list.push_back(value * factor);
  return list;
}

}  // namespace boresight::app
