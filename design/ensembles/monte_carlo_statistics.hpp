#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace boresight::design {

/// A number estimated from draws, with the interval that holds the truth in 95 % of such studies.
/// Infinite ends, or NaN throughout, where the draws are too few to say.
struct EstimatedNumber {
  double value = 0.0;
  double lower = 0.0;
  double upper = 0.0;
};

/// A quantile of a distribution, at its share of 0 to 1.
struct EstimatedQuantile {
  double share = 0.0;
  EstimatedNumber number;
};

/// A distribution seen through independent draws.
struct DistributionSummary {
  std::size_t draws = 0;
  EstimatedNumber mean;                // interval by the normal law
  EstimatedNumber standard_deviation;  // interval by the fourth moment
  double least = 0.0, largest = 0.0;
  std::vector<EstimatedQuantile> quantiles;
};

/// Mean, standard deviation (by n - 1) and quantiles at the shares. A quantile is the order
/// statistic between its neighbours (definition 7 of R. J. Hyndman and Y. Fan, The American
/// Statistician 50, 1996); its interval runs between the two order statistics that hold it with a
/// probability of 95 % or more whatever the distribution (exact, by the binomial law: H. A. David
/// and H. N. Nagaraja, Order Statistics, 2003, section 7.1). NaN throughout without draws.
/// @throws InvalidInput for a value that is not finite or a share outside (0, 1).
DistributionSummary summarise(std::vector<double> values, const std::vector<double>& shares);

/// A probability from so many hits among independent draws, by C. J. Clopper and E. S. Pearson,
/// Biometrika 26, 1934: holds the truth in 95 % of studies or more, whatever it is. 0 to 1 without
/// draws. @throws InvalidInput for more hits than draws.
EstimatedNumber probability(std::uint64_t hits, std::uint64_t draws);

/// Spearman's rank correlation, ties at their mean rank; the interval by Fisher's transformation
/// with the variance of D. G. Bonett and T. A. Wright, Psychometrika 65, 2000. NaN where either
/// does not vary, and for fewer than 10 pairs. @throws InvalidInput for sizes that differ.
EstimatedNumber rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace boresight::design
