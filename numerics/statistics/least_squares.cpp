#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/singular_values.hpp>
#include <boresight/numerics/statistics/least_squares.hpp>

namespace boresight::numerics {

std::string_view describe(LeastSquaresStatus status) {
  switch (status) {
    case LeastSquaresStatus::gradient_vanished:
      return "the gradient vanished";
    case LeastSquaresStatus::step_small:
      return "the last step was negligible";
    case LeastSquaresStatus::cost_flat:
      return "the sum of squares no longer fell";
    case LeastSquaresStatus::no_descent:
      return "no step however short lowered the sum of squares";
    case LeastSquaresStatus::iteration_limit:
      break;
  }
  return "the limit of iterations was reached";
}

namespace {

// The Jacobian's singular values in scaled parameters, and the residuals along them.
struct Subspace {
  numerics::SingularValues svd;
  Eigen::VectorXd along;  // U' r

  Subspace(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& scale,
           const Eigen::VectorXd& residuals)
      : svd(numerics::singular_values(jacobian * scale.cwiseInverse().asDiagonal())),
        along(svd.u.transpose() * residuals) {}

  // Norm of the damped step, and its derivative by the damping.
  double norm(double damping, double* slope) const {
    double square = 0.0, cube = 0.0;
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      const double s = svd.values(i);
      const double bottom = s * s + damping;
      if (!(bottom > 0.0)) continue;
      const double part = s * along(i) / bottom;
      square += part * part;
      cube += part * part / bottom;
    }
    const double length = std::sqrt(square);
    if (slope != nullptr) *slope = length > 0.0 ? -cube / length : 0.0;
    return length;
  }

  // Damping at which the step just reaches the radius; 0 if the undamped one stays within.
  double damping_for(double radius) const {
    double slope = 0.0;
    if (norm(min_damping(), &slope) <= radius) return min_damping();
    // 1/norm is nearly straight in the damping (Reinsch, Hebden): Newton from below, where it
    // converges without overshooting.
    double damping = min_damping();
    for (int k = 0; k < 60; ++k) {
      const double length = norm(damping, &slope);
      if (std::abs(length - radius) <= 0.05 * radius || slope == 0.0) break;
      damping = std::max(0.0, damping - (length - radius) / radius * length / slope);
    }
    return damping;
  }

  // Below it the smallest singular values are rounding only.
  double min_damping() const {
    const double unit = std::numeric_limits<double>::epsilon() * svd.values(0);
    return svd.values(svd.values.size() - 1) > 8.0 * unit ? 0.0 : unit * unit;
  }

  Eigen::VectorXd step(double damping) const {
    Eigen::VectorXd parts(along.size());
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      const double s = svd.values(i);
      const double bottom = s * s + damping;
      parts(i) = bottom > 0.0 ? -s * along(i) / bottom : 0.0;
    }
    return svd.v * parts;
  }

  // By how much the linear model's sum of squares falls.
  double fall(double damping) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      const double s2 = svd.values(i) * svd.values(i);
      const double bottom = s2 + damping;
      if (!(bottom > 0.0)) continue;
      const double left = damping / bottom;
      sum += along(i) * along(i) * (1.0 - left * left);
    }
    return sum;
  }
};

void check(const Eigen::VectorXd& start, const LeastSquaresOptions& options) {
  if (start.size() == 0 || !start.allFinite()) {
    throw InvalidInput(
        fmt::format("least_squares: expected a start of at least one finite parameter, found {}{}",
                    start.size(), start.size() == 0 ? "" : ", not all finite"));
  }
  if (options.iterations < 1 || !(options.step_tolerance >= 0.0) ||
      !(options.cost_tolerance >= 0.0) || !(options.first_radius > 0.0) ||
      !(options.rank_tolerance > 0.0)) {
    throw InvalidInput(fmt::format(
        "least_squares: expected iterations from 1, tolerances from 0, a positive radius and rank "
        "tolerance, found {}, {} and {}, {}, {}",
        options.iterations, options.step_tolerance, options.cost_tolerance, options.first_radius,
        options.rank_tolerance));
  }
}

Eigen::VectorXd column_norms(const Eigen::MatrixXd& jacobian) {
  Eigen::VectorXd norms = jacobian.colwise().norm().transpose();
  for (double& norm : norms) {
    if (!(norm > 0.0)) norm = 1.0;
  }
  return norms;
}

void finish(LeastSquaresResult& result, const Eigen::MatrixXd& jacobian, double rank_tolerance) {
  const Eigen::VectorXd scale = column_norms(jacobian);
  const auto svd = numerics::singular_values(jacobian * scale.cwiseInverse().asDiagonal());
  const Eigen::Index parameters = jacobian.cols();
  result.singular_values = Eigen::VectorXd::Zero(parameters);
  result.singular_values.head(svd.values.size()) = svd.values;
  result.condition = result.singular_values(0) / result.singular_values(parameters - 1);
  Eigen::MatrixXd spread(parameters, svd.values.size());
  for (Eigen::Index i = 0; i < svd.values.size(); ++i) {
    const bool counts = svd.values(i) > rank_tolerance * svd.values(0);
    result.rank += counts ? 1 : 0;
    spread.col(i) = counts ? (svd.v.col(i).cwiseQuotient(scale) / svd.values(i)).eval()
                           : Eigen::VectorXd::Zero(parameters).eval();
  }
  result.inverse_normal = spread * spread.transpose();
}

}  // namespace

LeastSquaresResult least_squares(const ResidualFunction& model, const Eigen::VectorXd& start,
                                 const LeastSquaresOptions& options) {
  check(start, options);
  LeastSquaresResult result;
  result.x = start;
  Eigen::VectorXd residuals, tried_residuals;
  Eigen::MatrixXd jacobian, tried_jacobian;
  model(result.x, residuals, &jacobian);
  result.evaluations = 1;
  if (!residuals.allFinite() || !jacobian.allFinite()) {
    throw InvalidInput(
        "least_squares: residuals or Jacobian are not finite at the start; start elsewhere");
  }
  double cost = residuals.squaredNorm();
  Eigen::VectorXd scale = column_norms(jacobian);
  double radius = options.first_radius * scale.cwiseProduct(start).norm();
  if (!(radius > 0.0)) radius = options.first_radius;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();

  bool done = false;
  while (!done && result.iterations < options.iterations) {
    ++result.iterations;
    scale = scale.cwiseMax(column_norms(jacobian));
    const Subspace tangent(jacobian, scale, residuals);
    if (tangent.along.squaredNorm() <= epsilon * epsilon * cost) {
      result.status = LeastSquaresStatus::gradient_vanished;
      break;
    }
    for (int shrinks = 0;; ++shrinks) {
      if (shrinks == 60) {
        result.status = LeastSquaresStatus::no_descent;
        done = true;
        break;
      }
      const double damping = tangent.damping_for(radius);
      const Eigen::VectorXd scaled_step = tangent.step(damping);
      const double length = scaled_step.norm();
      const Eigen::VectorXd tried = result.x + scaled_step.cwiseQuotient(scale);
      model(tried, tried_residuals, options.derive_when_trying ? &tried_jacobian : nullptr);
      ++result.evaluations;
      const double tried_cost = tried_residuals.allFinite()
                                    ? tried_residuals.squaredNorm()
                                    : std::numeric_limits<double>::infinity();
      const double expected = tangent.fall(damping) / cost;
      const double found = (cost - tried_cost) / cost;
      const bool negligible =
          length <= options.step_tolerance * scale.cwiseProduct(result.x).norm();
      const bool flat = expected <= options.cost_tolerance && found <= options.cost_tolerance;
      // A fall below rounding cannot be seen: the step is still the best one known.
      const bool unseen = std::abs(found) <= 64.0 * epsilon && expected <= 64.0 * epsilon;
      const double ratio = expected > 0.0 ? found / expected : 0.0;
      if (ratio < 0.25 && !unseen) {
        // Far worse than expected: far too long.
        radius = (found > -10.0 ? 0.5 : 0.1) * std::min(radius, 10.0 * length);
      } else if (ratio > 0.75 || damping == 0.0) {
        radius = std::max(radius, 2.0 * length);
      }
      const bool accepted = (found > 0.0 && ratio >= 1e-4) || (unseen && std::isfinite(tried_cost));
      if (accepted) {
        result.x = tried;
        if (options.derive_when_trying) {
          residuals.swap(tried_residuals);
          jacobian.swap(tried_jacobian);
        } else {
          model(result.x, residuals, &jacobian);
          ++result.evaluations;
        }
        cost = residuals.squaredNorm();
        if (!jacobian.allFinite()) {
          throw NumericalFailure("least_squares: the Jacobian is not finite within the search");
        }
      }
      if (cost == 0.0) {
        result.status = LeastSquaresStatus::gradient_vanished;
        done = true;
      } else if (negligible || (flat && accepted)) {
        result.status = negligible ? LeastSquaresStatus::step_small : LeastSquaresStatus::cost_flat;
        // So short a step, while the derivatives promise a descent that would count.
        const double counts = std::max(1e-8, options.cost_tolerance);
        if (!accepted && tangent.along.squaredNorm() > counts * cost) {
          result.status = LeastSquaresStatus::no_descent;
        }
        done = true;
      }
      if (accepted || done) break;
    }
  }
  result.sum_of_squares = cost;
  finish(result, jacobian, options.rank_tolerance);
  return result;
}

}  // namespace boresight::numerics
