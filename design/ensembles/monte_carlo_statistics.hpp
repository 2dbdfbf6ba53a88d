#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace boresight::design {

/// A number estimated from samples, with its 95 % confidence interval. Infinite ends, or NaN
/// throughout, where the samples are too few.
struct EstimatedNumber {
  double value = 0.0;
  double lower = 0.0;
  double upper = 0.0;
};

/// A quantile of a distribution, at a probability of 0 to 1.
struct EstimatedQuantile {
  double fraction = 0.0;
  EstimatedNumber number;
};

/// Summary of a distribution, estimated from independent samples.
struct DistributionSummary {
  std::size_t random_samples = 0;
  EstimatedNumber mean;                // interval by the normal distribution
  EstimatedNumber standard_deviation;  // interval by the fourth moment
  double minimum = 0.0, largest = 0.0;
  std::vector<EstimatedQuantile> quantiles;
};

/// Mean, standard deviation (by n - 1) and quantiles at the probabilities `fractions`. A quantile
/// is interpolated between order statistics (definition 7 of R. J. Hyndman and Y. Fan, The American
/// Statistician 50, 1996). Its interval lies between the two order statistics that contain it with
/// a probability of 95 % or more for any distribution (exact, by the binomial distribution: H. A.
/// David and H. N. Nagaraja, Order Statistics, 2003, section 7.1). NaN throughout without samples.
/// @throws InvalidInput for a value that is not finite or a probability outside (0, 1).
DistributionSummary summarise(std::vector<double> values, const std::vector<double>& fractions);

/// A probability estimated from a number of hits among independent samples, with the interval of C.
/// J. Clopper and E. S. Pearson, Biometrika 26, 1934. The coverage is 95 % or more for every true
/// probability. 0 to 1 without samples. @throws InvalidInput for more hits than samples.
EstimatedNumber probability(std::uint64_t hits, std::uint64_t random_samples);

/// Spearman's rank correlation, ties at their mean rank. The interval is by Fisher's transformation
/// with the variance of D. G. Bonett and T. A. Wright, Psychometrika 65, 2000. NaN where either
/// does not vary, and for fewer than 10 pairs. @throws InvalidInput for sizes that differ.
EstimatedNumber rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace boresight::design
