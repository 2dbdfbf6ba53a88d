#pragma once

#include <optional>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// How many states to keep: exactly one of the three.
struct BalancedTruncationOptions {
  std::optional<Eigen::Index> order{};
  /// Those whose Hankel singular value is above this.
  std::optional<double> singular_value_above{};
  /// The fewest for which BalancedTruncation::error_bound is not above this.
  std::optional<double> error_bound{};
  /// Keep the gain at frequency 0 by letting the neglected states settle at once (singular
  /// perturbation, K. D. V. Liu, B. D. O. Anderson, Int. J. Control 50, 1989) instead of dropping
  /// them, which keeps the gain at infinite frequency (D). Both have the same error bound.
  bool keep_static_gain = false;
};

struct BalancedTruncation {
  /// States balanced_1, balanced_2, ... with both Gramians diagonal and equal (without
  /// keep_static_gain).
  plant::StateSpace system;
  /// Of the given system, all of them, falling.
  Eigen::VectorXd hankel_singular_values;
  /// 2 times the sum of the neglected Hankel singular values: no gain of (given - reduced), at any
  /// frequency and in any direction, is above it (K. Glover, Int. J. Control 39, 1984).
  double error_bound = 0.0;
};

/// Balanced truncation of a stable system by the square-root method (M. S. Tombs, I. Postlethwaite,
/// Int. J. Control 46, 1987) on factors of the Gramians, which are never inverted: it stands
/// systems that are nearly or quite non-minimal. States whose Hankel singular value is rounding (n
/// eps of the largest) are not kept, whatever the order asked for. Continuous or sampled; gains are
/// compared in the units of inputs and outputs, so scale these first to what matters equally.
/// @throws InvalidInput as validate(system), unless exactly one of order, singular_value_above,
/// error_bound is given, or for one that is negative or an order above that of the system;
/// NumericalFailure if the system is not stable (split off what is not, and add it again), or the
/// reduced one would not be (a cut between equal Hankel singular values: take another order).
BalancedTruncation truncate_balanced(const plant::StateSpace& system,
                                     const BalancedTruncationOptions& options);

}  // namespace boresight::control
