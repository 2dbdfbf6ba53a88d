#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// Eigenvalues of a real square matrix, sorted by magnitude, then imaginary part.
/// @throws InvalidInput if it is not square or not finite; NumericalFailure if QR does not
/// converge.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// Right and left eigenvectors as columns, left ones scaled to left^H right = identity.
struct EigenDecomposition {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd right;
  Eigen::MatrixXcd left;
  /// Estimate of 1/(|right| |right^-1|), 1-norm: how far from defective.
  double reciprocal_condition = 1.0;
};

/// @throws as eigenvalues, and NumericalFailure if the eigenvectors are not independent to
/// working precision (defective matrix).
EigenDecomposition eigen_decomposition(const Eigen::MatrixXd& matrix);

/// The largest real part of the eigenvalues: negative for a stable system dx/dt = A x.
double spectral_abscissa(const Eigen::MatrixXd& matrix);

/// The largest magnitude of the eigenvalues: below 1 for a stable system x[k+1] = A x[k]. 0 without
/// states. @throws as eigenvalues.
double spectral_radius(const Eigen::MatrixXd& matrix);

}  // namespace boresight::numerics
