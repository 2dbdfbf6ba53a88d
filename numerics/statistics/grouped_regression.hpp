#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::numerics {

/// A linear regression whose errors are alike within groups of rows and independent between them.
struct GroupedRegression {
  Eigen::VectorXd coefficients;
  /// Of the coefficients, by leaving out one group after the other.
  Eigen::MatrixXd covariance;
  /// Groups less one: degrees of freedom of the covariance, for Student's t.
  double degrees_of_freedom = 0.0;
  /// One a coefficient; false: the regressors cannot tell it from others.
  std::vector<bool> determined;
};

/// Fits response = regressors * coefficients robustly: iteratively reweighted least squares, first
/// by Huber's function (1.345 standard deviations), then by Tukey's bisquare (6 of them), the
/// standard deviation by the median absolute residual (P. J. Huber, E. M. Ronchetti, Robust
/// Statistics, 2nd ed., 2009, 7.8). The covariance is the delete-a-group jackknife, (G - 1)/G times
/// the sum of squares of the G estimates without one group about their mean (B. Efron, The
/// Jackknife, the Bootstrap and Other Resampling Plans, 1982, chapter 3), enlarged for weights that
/// depend on the residuals by the mean weight over the mean slope of the influence, squared: it
/// holds for errors correlated within a group, whatever their spectrum.
///
/// `group`: one a row, from 0, rising. `noise_variance`: of each regressor's own errors,
/// independent from row to row, in squares of its unit; subtracted from the normal matrix so that
/// they do not bias the coefficients towards 0 (W. A. Fuller, Measurement Error Models, 1987, 1.2).
/// Empty: none.
/// @throws InvalidInput for sizes that do not fit, fewer than 8 groups, or numbers that are not
/// finite.
GroupedRegression grouped_regression(const Eigen::MatrixXd& regressors,
                                     const Eigen::VectorXd& response,
                                     const std::vector<Eigen::Index>& group,
                                     const Eigen::VectorXd& noise_variance = {});

}  // namespace boresight::numerics
