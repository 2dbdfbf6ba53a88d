#pragma once

#include <optional>

#include <Eigen/Core>

namespace boresight::control {

/// The matrices of a Riccati equation without cross term, G = B R^-1 B':
///   continuous  A'X + X A - X G X + Q = 0
///   sampled     A'X (1 + G X)^-1 A - X + Q = 0
struct RiccatiMatrices {
  Eigen::MatrixXd a, g, q;
};

/// Powers of two s for which S^-1 A S, S^-1 G S^-1 and S Q S (S = diag(s)) have rows and columns of
/// one order of magnitude. This is the symplectic balancing of the Hamiltonian matrix [A -G; -Q
/// -A'] (after P. Benner, SIAM J. Sci. Comput. 22, 2001). A common factor of all s scales X only. X
/// of the scaled equation is S X S.
Eigen::VectorXd riccati_scale(const RiccatiMatrices& matrices);

struct DoublingResult {
  Eigen::MatrixXd x;
  int doublings = 0;
};

/// The stabilising solution of the sampled equation by structure-preserving doubling. Nothing if it
/// does not converge within 60 doublings (closed-loop eigenvalues within 1e-18 of the boundary).
std::optional<DoublingResult> solve_by_doubling(RiccatiMatrices sampled);

/// The sampled equation with the same solution as a continuous one, by a Cayley transform. The
/// parameter c > 0 (1/s) must not equal an eigenvalue of A. Nothing if a matrix to be inverted is
/// singular to working precision.
std::optional<RiccatiMatrices> cayley_transform(const RiccatiMatrices& continuous, double c);

}  // namespace boresight::control
