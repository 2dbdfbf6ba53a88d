#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

struct PolePlacementOptions {
  /// Passes over the eigenvectors at most, with several inputs.
  int most_sweeps = 50;
};

/// A state feedback u = -K x and what it reaches.
struct PolePlacement {
  Eigen::MatrixXd gain;          // K, inputs x n
  Eigen::VectorXcd eigenvalues;  // of A - B K, sorted as numerics::eigenvalues
  /// How far the poles asked for are from being eigenvalues: the largest, over them, of the
  /// smallest singular value of A - B K - p, over |A - B K| (Frobenius), in balanced states. Some
  /// 1e-15, also where poles repeat and the eigenvalues themselves scatter.
  double backward_error = 0.0;
  /// |X| |X^-1| / n for the eigenvectors X of A - B K of unit length, Frobenius, in balanced
  /// states: 1 for orthogonal ones, infinite for chains. An eigenvalue moves by up to n times this
  /// for a change of A - B K by 1.
  double eigenvector_condition = 0.0;
};

/// Gives A - B K the poles asked for. One input (or several that act as one): the K there is, by
/// orthogonal deflation of one pole after the other (G. Miminis, C. C. Paige, Int. J. Control 35,
/// 1982). Several: of the many K one that makes the eigenvectors nearly orthogonal and so the poles
/// insensitive (J. Kautsky, N. K. Nichols, P. Van Dooren, Int. J. Control 41, 1985; A. L. Tits, Y.
/// Yang, IEEE Trans. Automat. Control 41, 1996). From balanced states and inputs of one size, so
/// units do not matter but in what "insensitive" means. Continuous and sampled alike; for an
/// observer place the poles of the transposed system.
///
/// It is a tool for low orders: with one input K grows without bound as the order does. Prefer
/// solve_riccati where poles are not given.
/// @throws InvalidInput as validate(system), for another number of poles than states, poles that
/// are not finite or not in conjugate pairs, or a pole more often than there are independent inputs
/// (with one input any number); NumericalFailure if inputs do not reach an eigenvalue, naming it,
/// or the backward error stays above 1e-8.
PolePlacement place_poles(const plant::StateSpace& system,
                          const std::vector<std::complex<double>>& poles,
                          const PolePlacementOptions& options = {});

}  // namespace boresight::control
