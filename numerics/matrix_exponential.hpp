#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// exp(A) by scaling and squaring of Pade approximants (A. H. Al-Mohy, N. J. Higham, SIAM J. Matrix
/// Anal. Appl. 31(3), 2009) of the balanced matrix, so that neither badly chosen units nor the
/// large couplings of a cascade cost digits. Relative error of some 1e-16 times the condition of
/// the problem, which is at least the norm of the balanced A.
/// @throws InvalidInput unless A is square and finite; NumericalFailure if exp(A) overflows.
Eigen::MatrixXd matrix_exponential(const Eigen::MatrixXd& a);

/// What dx/dt = A x + B u does within a time t, when u is held or rises evenly.
struct HeldTransition {
  Eigen::MatrixXd state;  // exp(A t), n x n
  Eigen::MatrixXd step;   // integral of exp(A s) ds B over 0..t, n x inputs: u = 1 throughout
  Eigen::MatrixXd ramp;   // integral of exp(A (t - s)) s/t ds B, n x inputs: u from 0 to 1
};

/// All three from one exponential of [A B 0; 0 0 I; 0 0 0] (C. F. Van Loan, IEEE Trans. Automatic
/// Control 23(3), 1978), without inverting A. B = I gives the integral of exp(A s). t >= 0 in s.
/// @throws as matrix_exponential, and InvalidInput for a B of other rows than A or a bad t.
HeldTransition held_transition(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double t);

}  // namespace boresight::numerics
