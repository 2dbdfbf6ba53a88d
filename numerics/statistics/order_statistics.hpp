#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace boresight::numerics {

/// The middle one of values by size; of an even number of them the larger of the two in the middle.
/// O(n). @throws InvalidInput for none.
double median(std::vector<double> values);
double median(const Eigen::VectorXd& values);

/// Quantile of values that rise, straight between neighbours (definition 7 of R. J. Hyndman and Y.
/// Fan, The American Statistician 50(4), 1996); infinite ones are equal to one another. `share`
/// within [0, 1]. @throws InvalidInput for none, or a share outside.
double quantile(std::span<const double> rising, double share);

/// Bound below the quantile at `share` (within (0, 1)) of a distribution, from `count` independent
/// draws: the rank (from 0) of the highest order statistic that lies above it with a probability of
/// at most `chance`; -1 for none. Free of the distribution: as many draws lie below the quantile as
/// is binomial (H. A. David, H. N. Nagaraja, Order Statistics, 3rd ed., 2003, 7.1).
std::ptrdiff_t rank_below_quantile(std::size_t count, double share, double chance);

}  // namespace boresight::numerics
