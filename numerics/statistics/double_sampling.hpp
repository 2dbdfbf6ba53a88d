#pragma once

#include <Eigen/Core>

#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::numerics {

/// Mean of y from few observations, corrected by an auxiliary x that is cheap and has many more
/// observations (regression estimator). n observations of y; n' of x, the first n of them paired
/// with the y; residual variance s_e of y on x; b = s_xy / s_xx:
///   m = mean(y) + b (mean of all x - mean of the first n),
///   var m = s_e / n (1 + n (mean of all x - mean of the first n)^2 / sum (x - mean)^2) +
///           (s_yy - s_e) / n',
/// its interval by Student's t with n - 2 degrees of freedom (W. G. Cochran, Sampling Techniques,
/// 3rd ed., 1977, section 12.6). A constant x gives no correction.
/// @throws InvalidInput for fewer than 4 observations, fewer x than y, or one that is not finite.
Interval mean_by_double_sampling(const Eigen::VectorXd& y, const Eigen::VectorXd& x);

}  // namespace boresight::numerics
