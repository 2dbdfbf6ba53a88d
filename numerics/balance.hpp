#pragma once

#include <Eigen/Core>

namespace boresight::numerics {

/// Scale factors s, powers of two, that make rows and columns of S^-1 A S (S = diag(s)) of nearly
/// one norm: A is then as close to normal as a diagonal scaling makes it, and nothing is rounded.
/// Scaling only, no permutation (B. N. Parlett, C. Reinsch, Numerische Mathematik 13, 1969; 2-norm
/// and stopping rule of R. James, J. Langou, B. Lowery, arXiv:1401.5766).
/// @throws InvalidInput unless A is square and finite.
Eigen::VectorXd balancing_scale(const Eigen::MatrixXd& a);

}  // namespace boresight::numerics
