#pragma once

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// Gramians of a stable system as factors: P = controllability controllability', which solves
/// A P + P A' + B B' = 0 (sampled A P A' - P + B B' = 0), and Q = observability observability', the
/// same for A' and C'. Found without forming P and Q (lyapunov_factor.hpp). n x n, lower
/// triangular.
struct GramianFactors {
  Eigen::MatrixXd controllability;
  Eigen::MatrixXd observability;
};

/// @throws InvalidInput as validate(system); NumericalFailure, with the margin, if the system is
/// not stable by more than rounding.
GramianFactors gramian_factors(const plant::StateSpace& system);

/// P and Q themselves, n x n, symmetric. @throws as gramian_factors.
Eigen::MatrixXd controllability_gramian(const plant::StateSpace& system);
Eigen::MatrixXd observability_gramian(const plant::StateSpace& system);

/// The square roots of the eigenvalues of P Q, in descending order: the energy gain of each
/// balanced state from past inputs to future outputs. Computed from the factors of P and Q,
/// accurate to about 1e-16 of the largest.
/// @throws as gramian_factors.
Eigen::VectorXd hankel_singular_values(const plant::StateSpace& system);

}  // namespace boresight::control
