#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// M = U diag(values) V' with orthonormal columns of U and V, values falling.
struct SingularValues {
  Eigen::MatrixXd u;  // rows x k
  Eigen::VectorXd values;
  Eigen::MatrixXd v;  // columns x k, k the smaller of rows and columns
};

/// By Jacobi rotations, which keep the digits of small singular values of graded matrices. O(n^3)
/// with a large constant: tens of states, not hundreds, in inner loops.
/// @throws InvalidInput if the matrix is not finite; NumericalFailure if the rotations do not
/// converge.
SingularValues singular_values(const Eigen::MatrixXd& matrix);

}  // namespace boresight::numerics
