#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

namespace boresight::control {

/// The row f for which A - b f has the `poles` (conjugates next to each other): A n x n, b n x 1,
/// reached. A and b are brought to Hessenberg form, b along the first axis; there the vector x with
/// (A - p) x along b is found by one sweep of rotations, f must have f x as its length, and the
/// rest of f belongs to the problem that is left when x is rotated onto the first axis (G. Miminis,
/// C. C. Paige, Int. J. Control 35, 1982). O(n^3).
Eigen::RowVectorXd place_with_one_input(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                        const std::vector<std::complex<double>>& poles);

}  // namespace boresight::control
