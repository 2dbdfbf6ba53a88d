#pragma once

#include <functional>
#include <string_view>

#include <Eigen/Core>

namespace boresight::numerics {

/// Writes the residuals at `x` and, unless `jacobian` is null, their derivatives (residuals x
/// parameters). Both keep their size from call to call. A residual that is not finite says that the
/// model has no value there.
using ResidualFunction = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& residuals,
                                            Eigen::MatrixXd* jacobian)>;

struct LeastSquaresOptions {
  int iterations = 1000;
  /// Relative size of a step, each parameter by its column's norm, below which it was the last one.
  double step_tolerance = 1e-12;
  /// Relative fall of the sum of squares, expected and found, below which a step was the last one.
  double cost_tolerance = 1e-15;
  /// First radius of trust, in units of the starting point's scaled norm.
  double first_radius = 1.0;
  /// Derivatives of every point tried, not only of those taken: better where they cost little more
  /// than the residuals.
  bool derive_when_trying = false;
  /// Singular values below this share of the largest, columns brought to the same norm, count as 0.
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
  /// Of the Jacobian with columns of norm 1, falling; how many count; the first over the last.
  Eigen::VectorXd singular_values;
  Eigen::Index rank = 0;
  double condition = 1.0;
  /// (J'J)^-1, directions without rank left out (parameters x parameters): times the residuals'
  /// variance that of the estimates.
  Eigen::MatrixXd inverse_normal;
  bool converged() const {
    return status != LeastSquaresStatus::iteration_limit &&
           status != LeastSquaresStatus::no_descent;
  }
};

/// Minimises |r(x)|^2 by the method of Levenberg and Marquardt with a radius of trust in scaled
/// parameters (J. J. More, The Levenberg-Marquardt algorithm: implementation and theory, Lecture
/// Notes in Mathematics 630, 1978), each step from the singular values of the Jacobian, so that a
/// Jacobian without full rank does no harm. O(residuals x parameters^2) an iteration.
/// @throws InvalidInput for an empty or non-finite start, options out of range, or residuals that
/// are not finite there.
LeastSquaresResult least_squares(const ResidualFunction& model, const Eigen::VectorXd& start,
                                 const LeastSquaresOptions& options = {});

}  // namespace boresight::numerics
