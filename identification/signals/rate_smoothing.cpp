#include <algorithm>

#include <boresight/identification/signals/rate_smoothing.hpp>

namespace boresight::identification {

Eigen::VectorXd moving_mean(const Eigen::Ref<const Eigen::VectorXd>& series, Eigen::Index half) {
  Eigen::VectorXd sum(series.size() + 1);
  sum(0) = 0.0;
  for (Eigen::Index i = 0; i < series.size(); ++i) sum(i + 1) = sum(i) + series(i);
  Eigen::VectorXd mean(series.size());
  for (Eigen::Index i = 0; i < series.size(); ++i) {
    const Eigen::Index from = std::max<Eigen::Index>(0, i - half);
    const Eigen::Index to = std::min(series.size(), i + half + 1);
    mean(i) = (sum(to) - sum(from)) / static_cast<double>(to - from);
  }
  return mean;
}

}  // namespace boresight::identification
