#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::numerics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

void check_symmetric(const MatrixXd& q, const char* what) {
  if (q.rows() != q.cols()) {
    throw InvalidInput(
        fmt::format("{}: expected a square matrix, found {} x {}", what, q.rows(), q.cols()));
  }
  if (!q.allFinite()) {
    throw InvalidInput(fmt::format("{}: the matrix has elements that are not finite", what));
  }
  const double asymmetry = (q - q.transpose()).norm();
  if (asymmetry > 1e-10 * q.norm()) {
    throw InvalidInput(
        fmt::format("{}: expected a symmetric matrix, found an antisymmetric part of {:.1e} of it",
                    what, 0.5 * asymmetry / q.norm()));
  }
}

[[noreturn]] void refuse(const char* what, Index row, double value) {
  throw InvalidInput(
      fmt::format("{}: expected a positive semidefinite matrix, found {:.3g} at row {} where "
                  "nothing negative may be (relative to its diagonal, after elimination)",
                  what, value, row + 1));
}

}  // namespace

MatrixXd semidefinite_factor(const MatrixXd& q, const char* what) {
  check_symmetric(q, what);
  const Index n = q.rows();
  Eigen::VectorXd scale(n);
  const double largest = n > 0 ? q.cwiseAbs().maxCoeff() : 0.0;
  for (Index i = 0; i < n; ++i) {
    if (q(i, i) < 0.0) refuse(what, i, -1.0);
    scale[i] = std::sqrt(q(i, i));
    // A zero on the diagonal leaves nothing beside it; the symmetric part of rounding may.
    if (q(i, i) == 0.0 && q.col(i).cwiseAbs().maxCoeff() > 1e-10 * largest) {
      refuse(what, i, -q.col(i).cwiseAbs().maxCoeff() / largest);
    }
  }
  const Eigen::VectorXd inverse = scale.unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  MatrixXd rest = inverse.asDiagonal() * (0.5 * (q + q.transpose())) * inverse.asDiagonal();

  const double negligible = 10.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  MatrixXd factor = MatrixXd::Zero(n, n);
  Index rank = 0;
  for (; rank < n; ++rank) {
    Index pivot = 0;
    const double value = rest.diagonal().maxCoeff(&pivot);
    if (!(value > negligible)) break;
    factor.col(rank) = rest.col(pivot) / std::sqrt(value);
    rest.noalias() -= factor.col(rank) * factor.col(rank).transpose();
    rest.col(pivot).setZero();
    rest.row(pivot).setZero();
  }
  // What is left of a semidefinite matrix is rounding.
  if (n > 0) {
    Index row = 0;
    Index column = 0;
    const double left = rest.cwiseAbs().maxCoeff(&row, &column);
    if (left > 1e-10) refuse(what, row, -left);
  }
  return scale.asDiagonal() * factor.leftCols(rank);
}

MatrixXd positive_definite_solve(const MatrixXd& p, const MatrixXd& right_hand_side,
                                 const char* what) {
  if (p.rows() != p.cols() || p.rows() != right_hand_side.rows()) {
    throw InvalidInput(
        fmt::format("{}: expected a square matrix and as many rows on the right, found {} x {} and "
                    "{} rows",
                    what, p.rows(), p.cols(), right_hand_side.rows()));
  }
  if (p.size() == 0) return right_hand_side;
  if (!(p.diagonal().minCoeff() > 0.0)) {
    throw NumericalFailure(
        fmt::format("{}: expected a positive definite matrix, found {:.3g} on its diagonal", what,
                    p.diagonal().minCoeff()));
  }
  const Eigen::VectorXd scale = p.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * p * scale.asDiagonal();
  return scale.asDiagonal() * linear_solve(scaled, scale.asDiagonal() * right_hand_side, what);
}

}  // namespace boresight::numerics
