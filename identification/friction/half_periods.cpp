#include <algorithm>
#include <cmath>
#include <vector>

#include <boresight/identification/friction/friction_tests.hpp>

namespace boresight::identification {

std::vector<HalfPeriod> half_periods(const Eigen::VectorXd& wave) {
  std::vector<HalfPeriod> found;
  if (wave.size() < 2) return found;
  std::vector<double> size(static_cast<std::size_t>(wave.size()));
  std::transform(wave.begin(), wave.end(), size.begin(), [](double x) { return std::abs(x); });
  const auto place =
      size.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(size.size() - 1));
  std::nth_element(size.begin(), place, size.end());
  const double level = 0.5 * *place;
  if (!(level > 0.0)) return found;
  int direction = 0;
  for (Eigen::Index i = 0; i < wave.size(); ++i) {
    const int now = wave(i) >= level ? 1 : wave(i) <= -level ? -1 : direction;
    if (now != direction) found.push_back({i, i, now});
    direction = now;
    if (!found.empty()) found.back().last = i;
  }
  Eigen::Index longest = 0;
  for (const auto& half : found) longest = std::max(longest, half.last - half.first + 1);
  std::erase_if(found, [longest](const HalfPeriod& half) {
    return 2 * (half.last - half.first + 1) < longest;
  });
  return found;
}

double mean_uncertainty(const Eigen::VectorXd& series) {
  const Eigen::Index count = series.size();
  if (count < 2) return 0.0;
  const Eigen::VectorXd centred = (series.array() - series.mean()).matrix();
  const double variance = centred.squaredNorm() / static_cast<double>(count);
  if (!(variance > 0.0)) return 0.0;
  double sum = variance;
  // A quarter of the series: longer lags are mean of too few products to say anything.
  for (Eigen::Index lag = 1; lag < count / 4; ++lag) {
    const double covariance =
        centred.head(count - lag).dot(centred.tail(count - lag)) / static_cast<double>(count);
    if (covariance <= 0.0) break;
    sum += 2.0 * covariance;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace boresight::identification
