#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// A result with its 95 % interval, SI.
struct Interval {
  double value = 0.0;
  double standard_uncertainty = 0.0;
  double lower = 0.0;  // 95 %, central
  double upper = 0.0;
};

/// Interval of the given value from samples about it: their standard deviation and their 2.5 % and
/// 97.5 % quantiles.
/// @throws InvalidInput for fewer than 20 samples or one that is not finite.
Interval interval_from_samples(double value, Eigen::VectorXd random_samples);

/// value +- 1.96 standard uncertainties. @throws InvalidInput for an uncertainty that is negative
/// or not finite.
Interval normal_interval(double value, double standard_uncertainty);

}  // namespace boresight::numerics
