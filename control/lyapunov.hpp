#pragma once

#include <Eigen/Core>

namespace boresight::control {

/// Solution of A P + P A' + Q = 0 and how well it solves it.
struct LyapunovSolution {
  Eigen::MatrixXd covariance;  // P, symmetric
  /// |A P + P A' + Q| / (2 |A| |P| + |Q|), Frobenius norms.
  double relative_residual = 0.0;
  /// -max Re(eigenvalue of A), 1/s.
  double stability_margin = 0.0;
};

/// Bartels-Stewart on the complex Schur form, O(n^3). A: n x n, stable; Q: n x n, symmetric.
/// @throws InvalidInput for shapes or elements that are not finite; NumericalFailure if A is not
/// stable (the margin is stated: an integrator or free angle that nothing uses must be removed
/// first) or the residual exceeds 1e-9.
LyapunovSolution solve_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q);

}  // namespace boresight::control
