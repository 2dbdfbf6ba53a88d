#pragma once

#include <Eigen/Core>

namespace boresight::plant {

/// V, n x rank, with V V' = Q for a symmetric positive semidefinite Q: Cholesky with complete
/// pivoting on Q scaled to a unit diagonal (N. J. Higham, Accuracy and Stability of Numerical
/// Algorithms, 2nd ed., 10.3), so that rank and verdict do not depend on units. Pivots below
/// 10 n eps count as 0. `what` names the matrix in errors.
/// @throws InvalidInput if Q is not square, not finite, not symmetric to 1e-10 or not positive
/// semidefinite to rounding, saying by how much.
Eigen::MatrixXd semidefinite_factor(const Eigen::MatrixXd& q, const char* what);

}  // namespace boresight::plant
