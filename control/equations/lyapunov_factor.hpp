#pragma once

#include <Eigen/Core>

#include <boresight/control/equations/schur_lyapunov.hpp>

namespace boresight::control {

/// Factors of the solution P of A P + P A' + B B' = 0 (sampled: A P A' - P + B B' = 0). They are
/// computed without forming B B' or P, so that small values keep digits that P itself loses.
/// Method: S. J. Hammarling, IMA J. Numer. Anal. 2, 1982, in complex arithmetic on the Schur form.

/// U, upper triangular, with U U^H the solution for an upper triangular T (complex Schur form). The
/// eigenvalues of T must be stable; `b` is in the coordinates of T. From the last row upwards each
/// step solves one triangular system and deflates b by a rank-one term. It takes n^3/3 + 2 n^2
/// columns complex operations.
Eigen::MatrixXcd triangular_lyapunov_factor(const Eigen::MatrixXcd& t, Eigen::MatrixXcd b,
                                            TimeDomain domain);

/// F, n x n complex, with F F^H = P (a real matrix).
struct LyapunovFactor {
  Eigen::MatrixXcd factor;
  /// -max Re(eigenvalue of A), 1/s; for a sampled system 1 - max |eigenvalue|.
  double stability_margin = 0.0;
};

/// A: n x n, stable; B: n x any. `scale`: units of the states, powers of two, in which the work is
/// done: plant::EvenUnits::state_unit, or ones. `function` is named in errors.
/// @throws InvalidInput for shapes or elements that are not finite; NumericalFailure if A is not
/// stable by more than rounding.
LyapunovFactor lyapunov_factor(const char* function, const Eigen::MatrixXd& a,
                               const Eigen::MatrixXd& b, const Eigen::VectorXd& scale,
                               TimeDomain domain);

/// The same in balanced states (numerics::balancing_scale), for callers without a C.
LyapunovFactor lyapunov_factor(const char* function, const Eigen::MatrixXd& a,
                               const Eigen::MatrixXd& b, TimeDomain domain);

/// L, n x n, with L L' = P: the same factor made real by one QR decomposition. Lower triangular.
Eigen::MatrixXd real_lyapunov_factor(const LyapunovFactor& complex);

}  // namespace boresight::control
