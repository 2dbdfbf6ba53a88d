#pragma once

#include <complex>
#include <functional>

#include <Eigen/Core>

#include <boresight/numerics/real_schur.hpp>

namespace boresight::numerics {

/// Moves the eigenvalues for which `first` holds to the head of the diagonal of a complex Schur
/// form, each group in the order it had, by rotations of neighbours (G. H. Golub, C. F. Van Loan,
/// Matrix Computations, 4th ed., 7.6.2): the leading columns of U then span their invariant
/// subspace. Returns how many there are.
Eigen::Index order_schur(ComplexSchur& schur,
                         const std::function<bool(std::complex<double>)>& first);

/// Y with T11 Y - Y T22 + T12 = 0, T11 the first `leading` rows and columns of the upper triangular
/// T: in the coordinates [I Y; 0 I] T is block-diagonal. A large Y is a nearly common eigenvalue of
/// the two.
/// @throws NumericalFailure if they share an eigenvalue.
Eigen::MatrixXcd decoupling(const Eigen::MatrixXcd& t, Eigen::Index leading);

}  // namespace boresight::numerics
