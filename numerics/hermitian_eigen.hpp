#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// Eigenvalues of a Hermitian matrix in rising order, orthonormal eigenvectors as columns.
struct HermitianEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXcd vectors;
};

/// Reads the lower triangle. @throws InvalidInput if it is not square or not finite;
/// NumericalFailure if the iteration does not converge.
HermitianEigen hermitian_eigen(const Eigen::MatrixXcd& matrix);

}  // namespace boresight::numerics
