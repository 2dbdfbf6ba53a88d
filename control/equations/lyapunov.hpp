#pragma once

#include <Eigen/Core>

namespace boresight::control {

struct LyapunovOptions {
  /// Whether to find LyapunovSolution::condition and error_bound: one more solution in Schur
  /// coordinates and a few products, some 15 % of the time.
  bool estimate_condition = true;
};

/// Solution of a Lyapunov equation and how well it solves it. Norms are taken in balanced states
/// (numerics/balance.hpp), so that states of very different size or unit all count.
struct LyapunovSolution {
  Eigen::MatrixXd covariance;  // P, symmetric
  /// |A P + P A' + Q| / (2 |A| |P| + |Q|), or |A P A' - P + Q| / (|A|^2 |P| + |P| + |Q|),
  /// Frobenius norms.
  double relative_residual = 0.0;
  /// -max Re(eigenvalue of A), 1/s; for a sampled system 1 - max |eigenvalue|.
  double stability_margin = 0.0;
  /// To first order the relative change of P for relative changes of A and Q by one, 2-norm. With
  /// H the solution for Q = I, |H| (2 |A| |P| + |Q|) / |P|, or |H| (2 |A|^2 |P| + |Q|) / |P|:
  /// for a stable A the inverse of the Lyapunov operator is largest on the identity, so 1/|H| is
  /// the separation of A from instability without estimate (G. Hewer, C. Kenney, SIAM J. Control
  /// Optim. 26, 1988; P. Gahinet et al., IEEE Trans. Automat. Control 35, 1990). 0 if not asked
  /// for.
  double condition = 0.0;
  /// Bound of |P - exact| / |P|, 2-norm, from |H|, the residual and the rounding in it. 0 if not
  /// asked for.
  double error_bound = 0.0;
};

/// A P + P A' + Q = 0 by Bartels and Stewart on the real Schur form of balanced A, O(n^3): the
/// covariance of the states of dx/dt = A x + noise of intensity Q, or with A' for A and C'C for Q
/// the energy that initial states put into the output. A: n x n, stable; Q: n x n, of which the
/// symmetric part counts.
/// @throws InvalidInput for shapes or elements that are not finite; NumericalFailure if A is not
/// stable by more than rounding (the margin is stated: an integrator or free angle that nothing
/// uses must be removed first) or the residual exceeds 1e-9.
LyapunovSolution solve_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q,
                                const LyapunovOptions& options = {});

/// A P A' - P + Q = 0 by Kitagawa's method on the real Schur form of balanced A: the covariance of
/// the states of x[k+1] = A x[k] + noise of covariance Q. A: n x n, every eigenvalue within the
/// unit circle; Q: n x n, of which the symmetric part counts.
/// @throws as solve_lyapunov.
LyapunovSolution solve_discrete_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q,
                                         const LyapunovOptions& options = {});

}  // namespace boresight::control
