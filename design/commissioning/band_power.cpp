#include <algorithm>
#include <array>
#include <cmath>

#include <boresight/design/commissioning/band_power.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::design {
namespace {

// Squared correlation of the spectrum at bins 0, 1 and 2 apart under Hann's window: (2/3)^2,
// (1/6)^2.
constexpr std::array window_correlation{1.0, 4.0 / 9.0, 1.0 / 36.0};

}  // namespace

BandPower band_power(const identification::SpectralMatrix& matrix, Eigen::Index channel,
                     double from, double to) {
  const Eigen::VectorXd density = matrix.auto_density(channel);
  const double bin = matrix.frequency[1] - matrix.frequency[0];
  double sum = 0.0;
  double covariance = 0.0;
  BandPower power;
  std::array<double, window_correlation.size()> last{};  // this density and those before it
  for (Eigen::Index i = 1; i < density.size(); ++i) {
    if (matrix.frequency[i] < from || matrix.frequency[i] >= to) continue;
    std::ranges::rotate(last, last.end() - 1);
    last[0] = density[i];
    sum += density[i];
    for (std::size_t lag = 0; lag < last.size(); ++lag) {
      const double correlation = window_correlation.at(lag);
      // Products of estimates are too large by what the two have in common.
      covariance += (lag == 0 ? 1.0 : 2.0) * correlation * last[0] * last.at(lag) /
                    (1.0 + correlation / matrix.effective_averages);
    }
    ++power.bins;
  }
  power.mean_square = sum * bin;
  if (covariance > 0.0) {
    power.freedom = 2.0 * matrix.effective_averages * std::max(1.0, sum * sum / covariance);
  }
  return power;
}

RatioBand rms_ratio(const BandPower& before, const BandPower& after, double confidence) {
  const double ratio = after.mean_square / before.mean_square;
  const double probability = 0.5 * (1.0 - confidence);
  const auto limit = [&](double fraction) {
    return std::sqrt(ratio / numerics::f_quantile(fraction, after.freedom, before.freedom));
  };
  return {std::sqrt(ratio), limit(1.0 - probability), limit(probability)};
}

RmsBand rms_interval(const BandPower& power, double confidence) {
  const double probability = 0.5 * (1.0 - confidence);
  const auto limit = [&](double fraction) {
    return std::sqrt(power.mean_square * power.freedom /
                     numerics::chi_squared_quantile(fraction, power.freedom));
  };
  return {std::sqrt(power.mean_square), limit(1.0 - probability), limit(probability)};
}

}  // namespace boresight::design
