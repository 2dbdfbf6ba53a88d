#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// V, n x rank, with V V' = Q for a symmetric positive semidefinite Q: Cholesky with complete
/// pivoting on Q scaled to a unit diagonal (N. J. Higham, Accuracy and Stability of Numerical
/// Algorithms, 2nd ed., 10.3), so that rank and verdict do not depend on units. Pivots below
/// 10 n eps count as 0. `what` names the matrix in errors.
/// @throws InvalidInput if Q is not square, not finite, not symmetric to 1e-10 or not positive
/// semidefinite to rounding, saying by how much.
Eigen::MatrixXd semidefinite_factor(const Eigen::MatrixXd& q, const char* what);

/// P^-1 B for a symmetric positive definite P, scaled to a unit diagonal first: rows in units of
/// any size. @throws InvalidInput for shapes that do not fit; NumericalFailure, naming `what`, if P
/// has a diagonal element that is not positive or is singular to working precision then.
Eigen::MatrixXd positive_definite_solve(const Eigen::MatrixXd& p,
                                        const Eigen::MatrixXd& right_hand_side, const char* what);

}  // namespace boresight::numerics
