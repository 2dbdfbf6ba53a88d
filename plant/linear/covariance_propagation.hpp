#pragma once

#include <Eigen/Core>

namespace boresight::plant {

/// What becomes of the covariance of the states of dx/dt = A x + white noise within a time.
struct PropagatedCovariance {
  Eigen::MatrixXd end;   // P(t)
  Eigen::MatrixXd mean;  // the mean of P over 0..t
};

/// P' = A P + P A' + W from P(0) = `start`, exactly: Van Loan's exponential over a short time (C.
/// F. Van Loan, IEEE Trans. Automatic Control 23(3), 1978), doubled until the time is reached, with
/// sums of positive terms only, so that poles fast against t cost no digits. A: n x n, any; W
/// (intensity: E w(t) w(s)' = W delta(t - s)) and `start`: n x n, symmetric; t > 0 in s. From start
/// = 0, `end` is the covariance of the noise of one sample.
/// @throws InvalidInput for shapes, elements that are not finite or a bad time; NumericalFailure if
/// it overflows.
PropagatedCovariance propagate_covariance(const Eigen::MatrixXd& a,
                                          const Eigen::MatrixXd& intensity,
                                          const Eigen::MatrixXd& start, double t);

}  // namespace boresight::plant
