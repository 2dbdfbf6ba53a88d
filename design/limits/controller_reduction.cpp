#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/limits/controller_reduction.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/singular_values.hpp>

namespace boresight::design {
namespace {

// F with F F' the Gramian: of semidefinite ones too, which rounding may leave slightly indefinite.
Eigen::MatrixXd factor(const Eigen::MatrixXd& gramian) {
  const auto parts = numerics::singular_values(0.5 * (gramian + gramian.transpose()));
  return parts.u * parts.values.cwiseSqrt().asDiagonal();
}

}  // namespace

ControllerReduction::ControllerReduction(const plant::StateSpace& controller,
                                         const ControllerGramians& gramians)
    : controller_(controller) {
  const Eigen::Index states = controller.a.rows();
  for (const Eigen::MatrixXd* gramian : {&gramians.covariance, &gramians.cost_to_go}) {
    if (gramian->rows() == states && gramian->cols() == states) continue;
    throw InvalidInput(
        fmt::format("controller reduction: expected Gramians of {} states, found {} x {}", states,
                    gramian->rows(), gramian->cols()));
  }
  const Eigen::MatrixXd reached = factor(gramians.covariance);
  const Eigen::MatrixXd seen = factor(gramians.cost_to_go);
  const auto hankel = numerics::singular_values(seen.transpose() * reached);
  singular_values_ = hankel.values;
  const double rounding = static_cast<double>(states) * std::numeric_limits<double>::epsilon();
  Eigen::Index kept = 0;
  while (kept < states && singular_values_[kept] > rounding * singular_values_[0]) ++kept;
  const Eigen::VectorXd root = singular_values_.head(kept).cwiseSqrt().cwiseInverse();
  right_ = reached * hankel.v.leftCols(kept) * root.asDiagonal();
  left_ = seen * hankel.u.leftCols(kept) * root.asDiagonal();
}

plant::StateSpace ControllerReduction::of_order(Eigen::Index order) const {
  if (order < 0 || order > largest_order()) {
    throw InvalidInput(fmt::format("controller reduction: expected an order from 0 to {}, found {}",
                                   largest_order(), order));
  }
  plant::StateSpace reduced = controller_;
  reduced.a = left_.leftCols(order).transpose() * controller_.a * right_.leftCols(order);
  reduced.b = left_.leftCols(order).transpose() * controller_.b;
  reduced.c = controller_.c * right_.leftCols(order);
  reduced.states.clear();
  for (Eigen::Index i = 1; i <= order; ++i) reduced.states.push_back(fmt::format("reduced_{}", i));
  return reduced;
}

}  // namespace boresight::design
