#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::design {

/// The active set at a minimum: gradients of the active objectives and constraints, one row each,
/// and the variables that rest on a bound.
struct ActiveSet {
  Eigen::MatrixXd objectives;   // at least one row: the cost is the largest objective
  Eigen::MatrixXd constraints;  // met where <= 0; rows may be none
  std::vector<bool> at_lower, at_upper;
};

/// Lagrange multipliers of an active set. Relaxing constraint i by d lowers the cost by
/// `constraints[i]` d. Lowering the lower bound of variable k by d lowers the cost by `lower[k]` d.
/// Upper bounds likewise.
struct Multipliers {
  Eigen::VectorXd objectives;  // weights, sum 1
  Eigen::VectorXd constraints;
  Eigen::VectorXd lower, upper;
  /// Norm of the objectives' gradient that the multipliers leave unbalanced, relative to the norm
  /// of that gradient. Small at a true minimum.
  double residual = 0.0;
};

/// Computes the multipliers by nonnegative least squares of the cost's gradient on the gradients of
/// the active constraints and bounds (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems,
/// 1974, ch. 23).
/// @throws InvalidInput for inconsistent shapes.
Multipliers active_multipliers(const ActiveSet& active);

/// Minimises |matrix x - right_hand_side| subject to every x >= 0.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side);

}  // namespace boresight::design
