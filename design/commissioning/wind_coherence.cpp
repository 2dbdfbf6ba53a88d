#include <algorithm>
#include <cmath>

#include <boresight/design/commissioning/wind_coherence.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::design {
namespace {

constexpr std::size_t fewest_records = 3;
constexpr double normal_95 = 1.6448536269514722;
// Sum of the squared correlations of a bin with its neighbours under Hann's window, 1 + 2 (4/9 +
// 1/36).
constexpr double correlated_bins = 1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0);

CoherentSpectra sum_of(const std::vector<CoherentSpectra>& records, std::size_t left_out) {
  const Eigen::Index bins = records.front().wind.size();
  CoherentSpectra sum{Eigen::ArrayXd::Zero(bins), Eigen::ArrayXd::Zero(bins),
                      Eigen::ArrayXcd::Zero(bins), 0.0};
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i == left_out) continue;
    const CoherentSpectra& one = records[i];
    sum.wind += one.averages * one.wind;
    sum.error += one.averages * one.error;
    sum.cross += one.averages * one.cross;
    sum.averages += one.averages;
  }
  sum.wind /= sum.averages;
  sum.error /= sum.averages;
  sum.cross /= sum.averages;
  return sum;
}

// The squared coherence without bias; 0 where wind or error have no power.
Eigen::ArrayXd unbiased_coherence(const CoherentSpectra& sum) {
  Eigen::ArrayXd result = Eigen::ArrayXd::Zero(sum.wind.size());
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const double powers = sum.wind[k] * sum.error[k];
    if (!(powers > 0.0)) continue;
    const double coherence = std::min(1.0, std::norm(sum.cross[k]) / powers);
    result[k] = (sum.averages * coherence - 1.0) / (sum.averages - 1.0);
  }
  return result;
}

// In a wind of that spectrum.
double coherent_power(const CoherentSpectra& sum, const Eigen::ArrayXd& wind) {
  const Eigen::ArrayXd coherence = unbiased_coherence(sum);
  double power = 0.0;
  for (Eigen::Index k = 0; k < wind.size(); ++k) {
    if (sum.wind[k] > 0.0) power += coherence[k] * sum.error[k] / sum.wind[k] * wind[k];
  }
  return power;
}

// Half the logarithm of the coherent power, and its variance by the jackknife over records.
struct LogRms {
  double value = 0.0, variance = 0.0;
};

std::optional<LogRms> log_rms(const std::vector<CoherentSpectra>& records,
                              const Eigen::ArrayXd& wind) {
  const auto log_of = [&](std::size_t left_out) {
    return 0.5 * std::log(coherent_power(sum_of(records, left_out), wind));
  };
  const auto count = static_cast<double>(records.size());
  LogRms result{log_of(records.size()), 0.0};
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double deviation = log_of(i) - result.value;
    sum += deviation;
    squares += deviation * deviation;
  }
  result.variance = (count - 1.0) / count * (squares - sum * sum / count);
  // The logarithm of a power below 0 is no number.
  if (!std::isfinite(result.value + result.variance)) return std::nullopt;
  return result;
}

}  // namespace

CoherentSpectra coherent_spectra(const identification::SpectralMatrix& spectra, Eigen::Index bins) {
  return {spectra.auto_density(0).segment(1, bins - 1).array(),
          spectra.auto_density(1).segment(1, bins - 1).array(),
          spectra.cross_density(0, 1).segment(1, bins - 1).array(), spectra.effective_averages};
}

ExplainedPower explained_power(const std::vector<CoherentSpectra>& records) {
  const CoherentSpectra sum = sum_of(records, records.size());
  const double power = sum.error.sum();
  if (!(sum.averages > 1.0) || !(power > 0.0)) return {0.0, 1.0};
  const double fraction = (unbiased_coherence(sum) * sum.error).sum() / power;
  // Without coherence the squared coherence of n averages scatters by 1/n.
  const double scatter =
      std::sqrt(correlated_bins * sum.error.square().sum()) / power / sum.averages;
  return {std::clamp(fraction, 0.0, 1.0), std::min(1.0, normal_95 * scatter)};
}

std::optional<RatioBand> coherent_ratio(const std::vector<CoherentSpectra>& before,
                                        const std::vector<CoherentSpectra>& after,
                                        double confidence) {
  if (std::min(before.size(), after.size()) < fewest_records) return std::nullopt;
  for (const auto* records : {&before, &after}) {
    const ExplainedPower explained = explained_power(*records);
    if (explained.fraction <= explained.threshold) return std::nullopt;
  }
  const Eigen::ArrayXd wind = sum_of(before, before.size()).wind + sum_of(after, after.size()).wind;
  const auto first = log_rms(before, wind);
  const auto second = log_rms(after, wind);
  if (!first || !second) return std::nullopt;
  const double variance = first->variance + second->variance;
  // Welch's and Satterthwaite's degrees of freedom.
  const auto part = [](const LogRms& one, std::size_t records) {
    return one.variance * one.variance / static_cast<double>(records - 1);
  };
  const double parts = part(*first, before.size()) + part(*second, after.size());
  const double freedom = parts > 0.0 ? variance * variance / parts
                                     : static_cast<double>(before.size() + after.size() - 2);
  const double half =
      numerics::student_quantile(0.5 + 0.5 * confidence, freedom) * std::sqrt(variance);
  const double value = second->value - first->value;
  return RatioBand{std::exp(value), std::exp(value - half), std::exp(value + half)};
}

}  // namespace boresight::design
