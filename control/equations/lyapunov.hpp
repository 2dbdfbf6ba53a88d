#pragma once

#include <Eigen/Core>

namespace boresight::control {

struct LyapunovOptions {
  /// Whether to compute LyapunovSolution::condition and error_bound. This takes one more solution
  /// in Schur coordinates and a few products, about 15 % of the time.
  bool estimate_condition = true;
};

/// Solution of a Lyapunov equation with its accuracy. Norms are taken in balanced states
/// (numerics/balance.hpp), so that states of very different size or unit all contribute.
struct LyapunovSolution {
  Eigen::MatrixXd covariance;  // P, symmetric
  /// |A P + P A' + Q| / (2 |A| |P| + |Q|), or |A P A' - P + Q| / (|A|^2 |P| + |P| + |Q|),
  /// Frobenius norms.
  double relative_residual = 0.0;
  /// -max Re(eigenvalue of A), 1/s; for a sampled system 1 - max |eigenvalue|.
  double stability_margin = 0.0;
  /// Relative change of P per relative change of A and Q, to first order, 2-norm. With H the
  /// solution for Q = I it is |H| (2 |A| |P| + |Q|) / |P|, sampled |H| (2 |A|^2 |P| + |Q|) / |P|.
  /// For a stable A the inverse of the Lyapunov operator is largest on the identity, so 1/|H| is
  /// exactly the separation of A from instability (G. Hewer, C. Kenney, SIAM J. Control Optim. 26,
  /// 1988; P. Gahinet et al., IEEE Trans. Automat. Control 35, 1990). 0 if not requested.
  double condition = 0.0;
  /// Bound of |P - exact| / |P|, 2-norm, from |H|, the residual and its rounding error. 0 if not
  /// requested.
  double error_bound = 0.0;
};

/// Solves A P + P A' + Q = 0 by Bartels and Stewart on the real Schur form of balanced A, O(n^3). P
/// is the covariance of the states of dx/dt = A x + noise of intensity Q. With A' for A and C'C for
/// Q it gives the output energy of initial states. A: n x n, stable; Q: n x n, of which the
/// symmetric part is used.
/// @throws InvalidInput for shapes or elements that are not finite; NumericalFailure if A is not
/// stable by more than rounding (the message states the margin; remove unused integrators and free
/// angles first) or the residual exceeds 1e-9.
LyapunovSolution solve_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q,
                                const LyapunovOptions& options = {});

/// Solves A P A' - P + Q = 0 by Kitagawa's method on the real Schur form of balanced A. P is the
/// covariance of the states of x[k+1] = A x[k] + noise of covariance Q. A: n x n, every eigenvalue
/// within the unit circle; Q: n x n, of which the symmetric part is used.
/// @throws as solve_lyapunov.
LyapunovSolution solve_discrete_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q,
                                         const LyapunovOptions& options = {});

}  // namespace boresight::control
