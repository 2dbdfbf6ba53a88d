#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::design {

/// What holds a minimum in place: gradients of the objectives and constraints that are active
/// there, one row each, and which variables rest on a bound.
struct ActiveSet {
  Eigen::MatrixXd objectives;   // at least one row: the cost is the largest objective
  Eigen::MatrixXd constraints;  // met where <= 0; rows may be none
  std::vector<bool> at_lower, at_upper;
};

/// Lagrange multipliers: the cost falls by `constraints[i]` times what constraint i is relaxed by,
/// by `lower[k]` times what the lower bound of variable k is lowered by, and so on.
struct Multipliers {
  Eigen::VectorXd objectives;  // weights, sum 1
  Eigen::VectorXd constraints;
  Eigen::VectorXd lower, upper;
  /// Length of what they leave of the objectives' gradient, over that gradient's length: small at a
  /// true minimum.
  double residual = 0.0;
};

/// Least squares of the cost's gradient on those of the active constraints and bounds, none of
/// which may pull (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, ch. 23).
/// @throws InvalidInput for shapes that do not fit.
Multipliers active_multipliers(const ActiveSet& active);

/// Least |matrix x - right_hand_side| with every x at least 0.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side);

}  // namespace boresight::design
