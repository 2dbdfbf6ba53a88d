#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

namespace boresight::control {

/// A gain F, inputs x n, for which A - U F has the `poles` (conjugates next to each other), with
/// eigenvectors as nearly orthogonal as sweeps over them make them. U: n x inputs, orthonormal
/// columns; no pole more often than there are columns. Each eigenvector must lie in a space of as
/// many dimensions as there are inputs. In turn each, or each pair, is replaced by the one of its
/// space that makes the determinant of all as large as it can be with the others as they are: the
/// projection of the direction orthogonal to the others (J. Kautsky, N. K. Nichols, P. Van Dooren,
/// Int. J. Control 41, 1985), and for a pair the extreme eigenvector of a Hermitian form (after
/// A. L. Tits, Y. Yang, IEEE Trans. Automat. Control 41, 1996), both read off the inverse of the
/// eigenvector matrix, which is updated with it. The best set met is taken. O(n^3) a sweep, O(n^4)
/// to begin with.
Eigen::MatrixXd place_with_several_inputs(const Eigen::MatrixXd& a, const Eigen::MatrixXd& u,
                                          const std::vector<std::complex<double>>& poles,
                                          int most_sweeps);

}  // namespace boresight::control
