#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// Solves matrix X = right_hand_side by LU with partial pivoting.
/// @throws InvalidInput for shapes that do not fit; NumericalFailure, naming `what`, if the matrix
/// is singular to working precision (reciprocal condition below 1e-15).
Eigen::MatrixXd linear_solve(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right_hand_side,
                             const char* what);

/// Solves a complex system by LU with partial pivoting; the result is not finite where the matrix
/// is singular. @throws InvalidInput for shapes that do not fit.
Eigen::MatrixXcd complex_solve(const Eigen::MatrixXcd& matrix,
                               const Eigen::MatrixXcd& right_hand_side);

/// C (s I - A)^-1 B + D at one complex s.
Eigen::MatrixXcd transfer_matrix(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                 const Eigen::MatrixXd& c, const Eigen::MatrixXd& d,
                                 std::complex<double> s);

}  // namespace boresight::numerics
