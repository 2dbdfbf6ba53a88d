#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/equations/stability_margin.hpp>
#include <boresight/control/reduction/balanced_truncation.hpp>
#include <boresight/control/reduction/gramians.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/real_schur.hpp>
#include <boresight/numerics/singular_values.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check(const plant::StateSpace& system, const BalancedTruncationOptions& options) {
  plant::validate(system);
  const int given = (options.order ? 1 : 0) + (options.singular_value_above ? 1 : 0) +
                    (options.error_bound ? 1 : 0);
  if (given != 1) {
    throw InvalidInput(
        fmt::format("truncate_balanced: expected one of order, singular_value_above and "
                    "error_bound, found {}",
                    given));
  }
  if (options.order && (*options.order < 0 || *options.order > system.a.rows())) {
    throw InvalidInput(
        fmt::format("truncate_balanced: expected an order from 0 to that of the system, {}, found "
                    "{}",
                    system.a.rows(), *options.order));
  }
  const double limit = options.singular_value_above.value_or(options.error_bound.value_or(0.0));
  if (!(limit >= 0.0)) {
    throw InvalidInput(
        fmt::format("truncate_balanced: expected a limit of 0 or more, found {}", limit));
  }
}

double sum_from(const VectorXd& values, Index first) {
  double sum = 0.0;
  for (Index i = values.size() - 1; i >= first; --i) sum += values[i];
  return sum;
}

Index order_for(const VectorXd& values, Index minimal, const BalancedTruncationOptions& options) {
  if (options.order) return std::min(*options.order, minimal);
  Index order = minimal;
  while (order > 0 &&
         (options.singular_value_above
              ? values[order - 1] <= *options.singular_value_above
              : 2.0 * sum_from(values, order - 1) <= options.error_bound.value_or(0.0))) {
    --order;
  }
  return order;
}

// The states from `order` on follow the others without delay.
void settle(plant::StateSpace& system, Index order) {
  const Index rest = system.a.rows() - order;
  if (rest == 0) return;
  // Continuous: 0 = A21 x1 + A22 x2 + B2 u; sampled: x2 = A21 x1 + A22 x2 + B2 u.
  MatrixXd settled = -system.a.bottomRightCorner(rest, rest);
  if (system.sample_time > 0.0) settled.diagonal().array() += 1.0;
  const MatrixXd from_states =
      numerics::linear_solve(settled, system.a.bottomLeftCorner(rest, order), "truncate_balanced");
  const MatrixXd from_inputs =
      numerics::linear_solve(settled, system.b.bottomRows(rest), "truncate_balanced");
  system.d += system.c.rightCols(rest) * from_inputs;
  system.b.topRows(order) += system.a.topRightCorner(order, rest) * from_inputs;
  system.c.leftCols(order) += system.c.rightCols(rest) * from_states;
  system.a.topLeftCorner(order, order) += system.a.topRightCorner(order, rest) * from_states;
}

void require_stable(const plant::StateSpace& reduced) {
  const TimeDomain domain =
      reduced.sample_time > 0.0 ? TimeDomain::sampled : TimeDomain::continuous;
  const MatrixXd a = plant::balanced(reduced).a;
  const StabilityMargin margin = stability_margin(numerics::real_schur(a).t, a.norm(), domain);
  if (!margin.stable()) {
    throw NumericalFailure(
        fmt::format("truncate_balanced: the system reduced to order {} is not stable (margin "
                    "{:.1e}): the cut falls between Hankel singular values that are equal; take "
                    "another order",
                    reduced.a.rows(), margin.value));
  }
}

}  // namespace

BalancedTruncation truncate_balanced(const plant::StateSpace& system,
                                     const BalancedTruncationOptions& options) {
  check(system, options);
  const Index n = system.a.rows();
  const auto [controllability, observability] = gramian_factors(system);
  const numerics::SingularValues hankel =
      numerics::singular_values(observability.transpose() * controllability);
  BalancedTruncation result;
  result.hankel_singular_values = hankel.values;
  Index minimal = 0;
  const double rounding = static_cast<double>(n) * std::numeric_limits<double>::epsilon() *
                          (n > 0 ? hankel.values[0] : 0.0);
  while (minimal < n && hankel.values[minimal] > rounding) ++minimal;
  const Index order = order_for(hankel.values, minimal, options);
  result.error_bound = 2.0 * sum_from(hankel.values, order);

  // What settles must be balanced along with what is kept.
  const Index balanced = options.keep_static_gain ? minimal : order;
  const VectorXd root = hankel.values.head(balanced).cwiseSqrt().cwiseInverse();
  const MatrixXd right = controllability * hankel.v.leftCols(balanced) * root.asDiagonal();
  const MatrixXd left = observability * hankel.u.leftCols(balanced) * root.asDiagonal();
  plant::StateSpace reduced = system;
  reduced.a = left.transpose() * system.a * right;
  reduced.b = left.transpose() * system.b;
  reduced.c = system.c * right;
  if (options.keep_static_gain) settle(reduced, order);
  reduced.a = reduced.a.topLeftCorner(order, order).eval();
  reduced.b = reduced.b.topRows(order).eval();
  reduced.c = reduced.c.leftCols(order).eval();
  reduced.states.clear();
  for (Index i = 1; i <= order; ++i) reduced.states.push_back(fmt::format("balanced_{}", i));
  require_stable(reduced);
  result.system = std::move(reduced);
  return result;
}

}  // namespace boresight::control
