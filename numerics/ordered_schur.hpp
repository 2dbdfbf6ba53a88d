#pragma once

#include <complex>
#include <functional>

#include <Eigen/Core>

#include <boresight/numerics/real_schur.hpp>

namespace boresight::numerics {

/// Moves the eigenvalues for which `first` holds to the head of the diagonal of a complex Schur
/// form, by rotations of neighbours (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed.,
/// 7.6.2). Each group keeps its order. The leading columns of U then span their invariant subspace.
/// Returns their number.
Eigen::Index order_schur(ComplexSchur& schur,
                         const std::function<bool(std::complex<double>)>& first);

/// Solves T11 Y - Y T22 + T12 = 0 for Y, T11 the first `leading` rows and columns of the upper
/// triangular T. In the coordinates [I Y; 0 I] T is block-diagonal. A large Y indicates a nearly
/// common eigenvalue of the two blocks.
/// @throws NumericalFailure if they have an eigenvalue in common.
Eigen::MatrixXcd decoupling(const Eigen::MatrixXcd& t, Eigen::Index leading);

}  // namespace boresight::numerics
