#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// A = U T U' with U orthogonal and T upper quasi-triangular: its diagonal blocks are 1 x 1 (a real
/// eigenvalue) or 2 x 2 of the form [a b; c a] with b c < 0 (the pair a +- j sqrt(-b c)); every
/// other element below the diagonal is exactly 0.
struct RealSchur {
  Eigen::MatrixXd t;
  Eigen::MatrixXd u;
};

/// Real Schur form by Householder reduction to Hessenberg form and Francis' implicitly double-
/// shifted QR (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., 7.5), with the deflation
/// test of M. Ahues and F. Tisseur (LAPACK Working Note 122, 1997), which respects small
/// eigenvalues of graded matrices. About 25 n^3 operations; A is not balanced here (balance.hpp).
/// The order of the eigenvalues along the diagonal is whatever the iteration finds.
/// @throws InvalidInput unless A is square and finite; NumericalFailure if QR does not converge
/// within 30 max(10, n) sweeps.
RealSchur real_schur(const Eigen::MatrixXd& a);

/// The Schur form of A' from that of A, by reversing the order: nothing is computed.
RealSchur transposed(const RealSchur& schur);

/// The eigenvalues in the order of the diagonal of `t`, of each pair the one with positive
/// imaginary part first. `t`: RealSchur::t.
Eigen::VectorXcd schur_eigenvalues(const Eigen::MatrixXd& t);

/// A = U T U^H with U unitary and T complex upper triangular.
struct ComplexSchur {
  Eigen::MatrixXcd t;
  Eigen::MatrixXcd u;
};

/// The complex form of a real one: each 2 x 2 block is split by one rotation, O(n^2) a block.
ComplexSchur complex_schur(const RealSchur& schur);

}  // namespace boresight::numerics
