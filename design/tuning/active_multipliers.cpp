#include <cmath>

#include <fmt/format.h>

#include <boresight/design/tuning/active_multipliers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Indices = std::vector<Index>;

// Least squares on some columns alone, by normal equations with a trace of damping: columns may
// depend on one another.
Eigen::VectorXd on_columns(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right_hand_side,
                           const Indices& columns) {
  const auto count = static_cast<Index>(columns.size());
  Eigen::MatrixXd normal(count, count);
  Eigen::VectorXd right(count);
  for (Index i = 0; i < count; ++i) {
    const auto column = matrix.col(columns[static_cast<std::size_t>(i)]);
    right[i] = column.dot(right_hand_side);
    for (Index j = 0; j < count; ++j) {
      normal(i, j) = column.dot(matrix.col(columns[static_cast<std::size_t>(j)]));
    }
  }
  normal.diagonal().array() += 1e-14 * normal.trace();
  return numerics::linear_solve(normal, right, "nonnegative least squares");
}

}  // namespace

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side) {
  const Index size = matrix.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  if (size == 0) return x;
  std::vector<bool> free(static_cast<std::size_t>(size), false);
  const double tolerance =
      1e-12 * (1.0 + right_hand_side.norm()) * (1.0 + matrix.cwiseAbs().maxCoeff());
  const Index max_steps = 10 * size + 10;
  for (Index step = 0; step < max_steps; ++step) {
    const Eigen::VectorXd pull = matrix.transpose() * (right_hand_side - matrix * x);
    Index enters = -1;
    for (Index k = 0; k < size; ++k) {
      if (!free[static_cast<std::size_t>(k)] && pull[k] > tolerance &&
          (enters < 0 || pull[k] > pull[enters])) {
        enters = k;
      }
    }
    if (enters < 0) break;
    free[static_cast<std::size_t>(enters)] = true;
    // Solve on the free columns; those that would pull stop at 0 and leave.
    for (Index inner = 0; inner <= size; ++inner) {
      Indices columns;
      for (Index k = 0; k < size; ++k) {
        if (free[static_cast<std::size_t>(k)]) columns.push_back(k);
      }
      if (columns.empty()) break;
      const Eigen::VectorXd wanted = on_columns(matrix, right_hand_side, columns);
      double fraction = 1.0;
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const double now = x[columns[i]], then = wanted[static_cast<Index>(i)];
        if (then <= 0.0) fraction = std::min(fraction, now / std::max(now - then, 1e-300));
      }
      for (std::size_t i = 0; i < columns.size(); ++i) {
        double& now = x[columns[i]];
        now += fraction * (wanted[static_cast<Index>(i)] - now);
        if (fraction < 1.0 && now <= 1e-14) {
          now = 0.0;
          free[static_cast<std::size_t>(columns[i])] = false;
        }
      }
      if (fraction == 1.0) break;
    }
  }
  return x;
}

Multipliers active_multipliers(const ActiveSet& active) {
  const Index variables = active.objectives.cols();
  const Index objectives = active.objectives.rows(), constraints = active.constraints.rows();
  const bool fits = objectives > 0 &&
                    (constraints == 0 || active.constraints.cols() == variables) &&
                    static_cast<Index>(active.at_lower.size()) == variables &&
                    static_cast<Index>(active.at_upper.size()) == variables;
  if (!fits) {
    throw InvalidInput(
        fmt::format("active_multipliers: expected at least one objective and gradients and bounds "
                    "of as many variables, found {} objectives of {}, {} constraints of {}, bounds "
                    "of {} and {}",
                    objectives, variables, constraints, active.constraints.cols(),
                    active.at_lower.size(), active.at_upper.size()));
  }
  Indices lower, upper;
  for (Index k = 0; k < variables; ++k) {
    if (active.at_lower[static_cast<std::size_t>(k)]) lower.push_back(k);
    if (active.at_upper[static_cast<std::size_t>(k)]) upper.push_back(k);
  }
  const auto bounds = static_cast<Index>(lower.size() + upper.size());
  // The last row makes the objectives' weights sum to 1; of large weight, so that it is nearly met.
  const double scale = std::max(active.objectives.rowwise().norm().maxCoeff(), 1e-300);
  const double weight = 10.0 * scale;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(variables + 1, objectives + constraints + bounds);
  matrix.topLeftCorner(variables, objectives) = active.objectives.transpose();
  matrix.bottomLeftCorner(1, objectives).setConstant(weight);
  if (constraints > 0) {
    matrix.block(0, objectives, variables, constraints) = active.constraints.transpose();
  }
  Index column = objectives + constraints;
  for (const Index k : lower) matrix(k, column++) = -1.0;
  for (const Index k : upper) matrix(k, column++) = 1.0;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(variables + 1);
  right[variables] = weight;

  // Columns of length 1: the gradients of steep constraints have no more weight than others.
  Eigen::VectorXd length = matrix.colwise().norm();
  length = (length.array() > 0.0).select(length, 1.0);
  Eigen::VectorXd x = nonnegative_least_squares(matrix * length.cwiseInverse().asDiagonal(), right);
  x.array() /= length.array();
  x /= x.head(objectives).sum();
  Multipliers found;
  found.objectives = x.head(objectives);
  found.constraints = x.segment(objectives, constraints);
  found.lower = found.upper = Eigen::VectorXd::Zero(variables);
  column = objectives + constraints;
  for (const Index k : lower) found.lower[k] = x[column++];
  for (const Index k : upper) found.upper[k] = x[column++];
  const Eigen::VectorXd gradient = active.objectives.transpose() * found.objectives;
  found.residual = (matrix * x).head(variables).norm() / std::max(gradient.norm(), 1e-300);
  return found;
}

}  // namespace boresight::design
