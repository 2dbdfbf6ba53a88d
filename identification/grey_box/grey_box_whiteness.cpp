#include <algorithm>
#include <cmath>

#include <boresight/identification/grey_box/grey_box_whiteness.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::identification {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd autocorrelations(const VectorXd& series, Index lags) {
  VectorXd out = VectorXd::Zero(lags);
  const double power = series.squaredNorm();
  if (!(power > 0.0)) return out;
  for (Index lag = 1; lag <= lags && lag < series.size(); ++lag) {
    out(lag - 1) = series.head(series.size() - lag).dot(series.tail(series.size() - lag)) / power;
  }
  return out;
}

std::vector<GreyBoxResidual> residual_statistics(const GreyBoxObjective& objective,
                                                 const std::vector<GreyBoxRecord>& records,
                                                 const VectorXd& point) {
  constexpr Index tested = 20;
  const double limit = numerics::chi_squared_quantile(0.95, static_cast<double>(tested));
  std::vector<GreyBoxResidual> out;
  for (std::size_t i = 0; i < objective.channels().size(); ++i) {
    const auto& channel = objective.channels()[i];
    const VectorXd errors = objective.errors(point, i);
    GreyBoxResidual r;
    r.record = records[channel.record].name;
    r.pressures = channel.pressures;
    r.counted = channel.counted;
    r.outliers = channel.outliers;
    r.rms = channel.scale *
            std::sqrt(errors.squaredNorm() / static_cast<double>(std::max<Index>(1, r.counted)));
    // Both sides' errors alternate: the larger of their correlations counts. A negative one takes
    // nothing off the number of independent errors.
    const Index series = channel.pressures ? 2 : 1;
    const Index length = errors.size() / series;
    const Index longest = std::min<Index>(length / 4, 2000);
    VectorXd worst = VectorXd::Zero(std::max(longest, tested));
    for (Index s = 0; s < series; ++s) {
      const VectorXd one = Eigen::Map<const VectorXd, 0, Eigen::InnerStride<>>(
          errors.data() + s, length, Eigen::InnerStride<>(series));
      worst = worst.cwiseMax(autocorrelations(one, worst.size()));
      const VectorXd first = autocorrelations(one, tested);
      const double n = static_cast<double>(length);
      double q = 0.0;
      for (Index lag = 1; lag <= tested; ++lag) {
        q += n * (n + 2.0) * first(lag - 1) * first(lag - 1) /
             std::max(1.0, n - static_cast<double>(lag));
      }
      r.white = (s == 0 || r.white) && q <= limit;
      if (std::abs(first(0)) > std::abs(r.neighbours)) r.neighbours = first(0);
    }
    // Summed until the correlation first vanishes.
    double sum = 1.0;
    for (Index lag = 0; lag < worst.size() && worst(lag) > 0.0; ++lag) sum += 2.0 * worst(lag);
    r.effective = static_cast<double>(r.counted) / sum;
    out.push_back(r);
  }
  return out;
}

}  // namespace boresight::identification
