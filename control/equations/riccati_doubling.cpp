#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include <boresight/control/equations/riccati_doubling.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double min_reciprocal_condition = 1e-14;

void symmetrise(MatrixXd& matrix) {
  matrix = 0.5 * (matrix + matrix.transpose()).eval();
}

}  // namespace

Eigen::VectorXd riccati_scale(const RiccatiMatrices& matrices) {
  const Index n = matrices.a.rows();
  MatrixXd a = matrices.a;
  MatrixXd g = matrices.g;
  MatrixXd q = matrices.q;
  a.diagonal().setZero();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
  constexpr int max_passes = 60;
  bool changed = true;
  for (int pass = 0; changed && pass < max_passes; ++pass) {
    changed = false;
    for (Index i = 0; i < n; ++i) {
      const double row = a.row(i).squaredNorm() + g.col(i).squaredNorm();
      const double column = a.col(i).squaredNorm() + q.col(i).squaredNorm();
      if (row == 0.0 || column == 0.0 || !std::isfinite(row) || !std::isfinite(column)) continue;
      // Elements beside the diagonal of G and Q scale with the factor, those on it with its square:
      // half the step that would make row and column equal if all stood beside it.
      const double factor = std::exp2(std::round(0.125 * std::log2(row / column)));
      if (factor == 1.0) continue;
      a.col(i) *= factor;
      a.row(i) /= factor;
      q.col(i) *= factor;
      q.row(i) *= factor;
      g.col(i) /= factor;
      g.row(i) /= factor;
      scale[i] *= factor;
      changed = true;
    }
  }
  return scale;
}

std::optional<DoublingResult> solve_by_doubling(RiccatiMatrices sampled) {
  auto& [a, g, h] = sampled;
  const Index n = a.rows();
  constexpr int max_doublings = 60;
  // With the increment of H at 1e-9 of it the next would be at its square.
  constexpr double converged = 1e-9;
  MatrixXd inverse_a(n, n);
  MatrixXd inverse_g(n, n);
  MatrixXd product(n, n);
  MatrixXd increment(n, n);
  Eigen::PartialPivLU<MatrixXd> lu(n);
  for (int k = 1; k <= max_doublings; ++k) {
    product.noalias() = g * h;
    product.diagonal().array() += 1.0;
    lu.compute(product);
    inverse_a = lu.solve(a);
    inverse_g = lu.solve(g);
    // H += A' H (1 + G H)^-1 A, G += A (1 + G H)^-1 G A', A <- A (1 + G H)^-1 A
    product.noalias() = h * inverse_a;
    increment.noalias() = a.transpose() * product;
    symmetrise(increment);
    h += increment;
    const double size = h.norm();
    if (!std::isfinite(size)) return std::nullopt;
    if (increment.norm() <= converged * size) return DoublingResult{std::move(h), k};
    product.noalias() = a * inverse_g;
    increment.noalias() = product * a.transpose();
    symmetrise(increment);
    g += increment;
    product.noalias() = a * inverse_a;
    a.swap(product);
  }
  return std::nullopt;
}

std::optional<RiccatiMatrices> cayley_transform(const RiccatiMatrices& continuous, double c) {
  const auto& [a, g, q] = continuous;
  MatrixXd shifted = a;
  shifted.diagonal().array() -= c;
  const Eigen::PartialPivLU<MatrixXd> lu(shifted);
  if (!(lu.rcond() > min_reciprocal_condition)) return std::nullopt;
  const MatrixXd inverse = lu.inverse();
  // W = (A - c)' + Q (A - c)^-1 G
  const MatrixXd inverse_g = inverse * g;
  MatrixXd w = shifted.transpose();
  w.noalias() += q * inverse_g;
  const Eigen::PartialPivLU<MatrixXd> w_lu(w);
  if (!(w_lu.rcond() > min_reciprocal_condition)) return std::nullopt;
  const MatrixXd v = w_lu.inverse();
  RiccatiMatrices result;
  result.a = 2.0 * c * v.transpose();
  result.a.diagonal().array() += 1.0;
  result.g = 2.0 * c * (inverse_g * v);
  const MatrixXd q_inverse = q * inverse;
  result.q = 2.0 * c * (v * q_inverse);
  symmetrise(result.g);
  symmetrise(result.q);
  if (!(result.a.allFinite() && result.g.allFinite() && result.q.allFinite())) return std::nullopt;
  return result;
}

}  // namespace boresight::control
