#pragma once

#include <optional>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// Selection of the states to keep: exactly one of the three.
struct BalancedTruncationOptions {
  std::optional<Eigen::Index> order{};
  /// Keep the states with a Hankel singular value above this.
  std::optional<double> singular_value_above{};
  /// Keep the fewest states for which BalancedTruncation::error_bound does not exceed this.
  std::optional<double> error_bound{};
  /// Preserve the gain at frequency 0 by letting the neglected states settle at once (singular
  /// perturbation, K. D. V. Liu, B. D. O. Anderson, Int. J. Control 50, 1989). Otherwise the states
  /// are dropped, which preserves the gain at infinite frequency (D). Both have the same error
  /// bound.
  bool keep_static_gain = false;
};

struct BalancedTruncation {
  /// States balanced_1, balanced_2, ... with both Gramians diagonal and equal (without
  /// keep_static_gain).
  plant::StateSpace system;
  /// All of the given system's, in descending order.
  Eigen::VectorXd hankel_singular_values;
  /// 2 times the sum of the neglected Hankel singular values. No gain of (given - reduced), at any
  /// frequency and in any direction, exceeds it (K. Glover, Int. J. Control 39, 1984).
  double error_bound = 0.0;
};

/// Balanced truncation of a stable system by the square-root method (M. S. Tombs, I. Postlethwaite,
/// Int. J. Control 46, 1987) on factors of the Gramians. These are never inverted, so nearly or
/// exactly non-minimal systems are permitted. States with a Hankel singular value at rounding level
/// (n eps of the largest) are not kept, whatever the requested order. Continuous or sampled. Gains
/// are compared in the units of inputs and outputs; scale these first to equal importance.
/// @throws InvalidInput as validate(system), unless exactly one of order, singular_value_above,
/// error_bound is given, or for one that is negative or an order above that of the system;
/// NumericalFailure if the system is not stable (separate the unstable part and add it again), or
/// the reduced one would not be (a cut between equal Hankel singular values: use another order).
BalancedTruncation truncate_balanced(const plant::StateSpace& system,
                                     const BalancedTruncationOptions& options);

}  // namespace boresight::control
