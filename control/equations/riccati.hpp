#pragma once

#include <Eigen/Core>

namespace boresight::control {

/// Weights on the states and inputs of dx/dt = A x + B u (x[k+1] = A x[k] + B u[k]): the cost is
/// the integral (sum) of x'Q x + 2 x'S u + u'R u.
struct RiccatiProblem {
  Eigen::MatrixXd a;  // n x n
  Eigen::MatrixXd b;  // n x inputs
  Eigen::MatrixXd q;  // n x n, symmetric
  Eigen::MatrixXd r;  // inputs x inputs, symmetric positive definite
  Eigen::MatrixXd s;  // n x inputs; empty for 0. Q - S R^-1 S' must be positive semidefinite
};

struct RiccatiOptions {
  /// Whether to compute RiccatiSolution::condition and error_bound. This takes two more solutions
  /// of Lyapunov equations in Schur coordinates, about 5 % of the time.
  bool estimate_condition = true;
};

/// The stabilising solution X. Norms are taken in scaled states, in which the terms of the equation
/// have one order of magnitude.
struct RiccatiSolution {
  Eigen::MatrixXd x;              // n x n, symmetric positive semidefinite
  Eigen::MatrixXd gain;           // K, inputs x n: u = -K x is optimal
  Eigen::VectorXcd eigenvalues;   // of A - B K, sorted as numerics::eigenvalues
  double stability_margin = 0.0;  // of A - B K: -max Re, 1/s; sampled 1 - max magnitude
  /// Frobenius norm of the residual, relative to the sum of the norms of the terms of the equation
  /// with the elements of every factor made positive. Rounding leaves about 1e-16.
  double relative_residual = 0.0;
  /// Relative change of X per relative change of A, B R^-1 B' and Q, to first order, 2-norm. This
  /// is the bound of C. Kenney, G. Hewer, SIAM J. Control Optim. 28, 1990 (after R. Byers), by the
  /// Lyapunov equations of the closed loop. 0 if not requested.
  double condition = 0.0;
  /// Bound of |X - exact|/|X| from the residual and its rounding error. 0 if not requested.
  double error_bound = 0.0;
  int doublings = 0;
  int newton_steps = 0;
};

/// Solves A'X + X A - (X B + S) R^-1 (X B + S)' + Q = 0, K = R^-1 (X B + S)'.
///
/// The matrices are scaled by powers of two to balance the Hamiltonian matrix. X is computed by
/// structure-preserving doubling after a Cayley transform (E. K.-W. Chu, H.-Y. Fan, W.-W. Lin,
/// Linear Algebra Appl. 396, 2005), which converges quadratically and keeps X symmetric and
/// semidefinite. Newton's method (D. L. Kleinman, 1968) refines it to rounding accuracy. O(n^3).
///
/// @throws InvalidInput for shapes or elements that are not finite, Q or R that are not symmetric,
/// R not positive definite or Q - S R^-1 S' not positive semidefinite; NumericalFailure if (A, B)
/// is not stabilisable or (A - B R^-1 S', Q - S R^-1 S') not detectable, naming which and the
/// eigenvalues (to 1e-12, see ModeAccess::distance), or if no stabilising solution is found to a
/// relative residual of 1e-9.
RiccatiSolution solve_riccati(const RiccatiProblem& problem, const RiccatiOptions& options = {});

/// Solves A'X A - X - (A'X B + S) (R + B'X B)^-1 (A'X B + S)' + Q = 0, K = (R + B'X B)^-1 (B'X A +
/// S'). Uses doubling directly (also for singular A) and Newton's method (G. A. Hewer, 1971).
/// @throws as solve_riccati.
RiccatiSolution solve_discrete_riccati(const RiccatiProblem& problem,
                                       const RiccatiOptions& options = {});

}  // namespace boresight::control
