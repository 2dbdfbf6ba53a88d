#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace boresight::numerics {

/// Median; of an even number of values the larger of the two in the middle. O(n).
/// @throws InvalidInput for none.
double median(std::vector<double> values);
double median(const Eigen::VectorXd& values);

/// Quantile of ascending values, interpolated linearly (definition 7 of R. J. Hyndman and Y. Fan,
/// The American Statistician 50(4), 1996); infinite values are equal to each other. `fraction`:
/// probability, within [0, 1].
/// @throws InvalidInput for no values or a probability outside.
double quantile(std::span<const double> rising, double fraction);

/// Rank (from 0) of the order statistic that is a lower confidence bound of the quantile at
/// probability `fraction` (within (0, 1)), from `count` independent samples. It is the highest one
/// that exceeds the quantile with a probability of at most `probability`; -1 for none.
/// Distribution-free: the number of samples below the quantile is binomial (H. A. David, H. N.
/// Nagaraja, Order Statistics, 3rd ed., 2003, 7.1).
std::ptrdiff_t rank_below_quantile(std::size_t count, double fraction, double probability);

}  // namespace boresight::numerics
