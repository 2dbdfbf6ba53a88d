#pragma once

#include <functional>
#include <string_view>

#include <Eigen/Core>

namespace boresight::numerics {

/// Writes the residuals at `x` and, unless `jacobian` is null, their derivatives (residuals x
/// parameters). Both keep their size from call to call. A residual that is not finite marks a point
/// outside the model's domain.
using ResidualFunction = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& residuals,
                                            Eigen::MatrixXd* jacobian)>;

struct LeastSquaresOptions {
  int iterations = 1000;
  /// Stops after a step whose relative size, each parameter scaled by its column's norm, is below
  /// this.
  double step_tolerance = 1e-12;
  /// Stops after a step whose relative fall of the sum of squares, predicted and actual, is below
  /// this.
  double cost_tolerance = 1e-15;
  /// Initial trust-region radius, in units of the starting point's scaled norm.
  double first_radius = 1.0;
  /// Compute derivatives at every trial point, not only at accepted ones: better if they cost
  /// little more than the residuals.
  bool derive_when_trying = false;
  /// Singular values below this fraction of the largest, columns scaled to the same norm, count as
  /// 0.
  double rank_tolerance = 1e-12;
};

enum class LeastSquaresStatus {
  gradient_vanished,  // the residuals stand square on the model's tangent plane
  step_small,
  cost_flat,
  no_descent,  // no step however short lowers the sum of squares: derivatives or model are not
               // smooth
  iteration_limit
};

/// What a status means, in words.
std::string_view describe(LeastSquaresStatus status);

struct LeastSquaresResult {
  Eigen::VectorXd x;
  LeastSquaresStatus status = LeastSquaresStatus::iteration_limit;
  double sum_of_squares = 0.0;
  int iterations = 0;
  int evaluations = 0;  // of the residuals
  /// Of the Jacobian with columns of norm 1, decreasing; the numerical rank; the largest over the
  /// smallest.
  Eigen::VectorXd singular_values;
  Eigen::Index rank = 0;
  double condition = 1.0;
  /// (J'J)^-1 without the directions of zero rank (parameters x parameters). Times the residuals'
  /// variance it is the covariance of the estimates.
  Eigen::MatrixXd inverse_normal;
  bool converged() const {
    return status != LeastSquaresStatus::iteration_limit &&
           status != LeastSquaresStatus::no_descent;
  }
};

/// Minimises |r(x)|^2 by the Levenberg-Marquardt method with a trust region in scaled parameters
/// (J. J. More, The Levenberg-Marquardt algorithm: implementation and theory, Lecture Notes in
/// Mathematics 630, 1978). Each step is computed from the singular values of the Jacobian, so a
/// rank-deficient Jacobian is permitted. O(residuals x parameters^2) per iteration.
/// @throws InvalidInput for an empty or non-finite start, options out of range, or residuals that
/// are not finite there.
LeastSquaresResult least_squares(const ResidualFunction& model, const Eigen::VectorXd& start,
                                 const LeastSquaresOptions& options = {});

}  // namespace boresight::numerics
