#include <cmath>

#include <Eigen/Householder>

#include <boresight/control/reduction/single_input_placement.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

// A = Q H Q', b = beta Q e1.
struct ControllerHessenberg {
  MatrixXd h, q;
  double beta = 0.0;
};

ControllerHessenberg controller_hessenberg(const MatrixXd& a, const Eigen::VectorXd& b) {
  const Index n = a.rows();
  ControllerHessenberg result{a, MatrixXd::Identity(n, n), 0.0};
  Eigen::VectorXd essential(n);
  Eigen::VectorXd workspace(n);
  double tau = 0.0;
  for (Index k = -1; k + 1 < n; ++k) {
    // Reflects rows and columns k + 1.. so that b, or column k, has one element there.
    const Index rest = n - k - 1;
    const Eigen::VectorXd column = k < 0 ? b : Eigen::VectorXd(result.h.col(k).tail(rest));
    auto tail = essential.head(rest - 1);
    double image = 0.0;
    column.makeHouseholder(tail, tau, image);
    if (k < 0) result.beta = image;
    result.h.bottomRows(rest).applyHouseholderOnTheLeft(tail, tau, workspace.data());
    result.h.rightCols(rest).applyHouseholderOnTheRight(tail, tau, workspace.data());
    result.q.rightCols(rest).applyHouseholderOnTheRight(tail, tau, workspace.data());
  }
  return result;
}

// [x y] <- [x y] [c -conj(s); s c]: turns columns, c real.
struct Rotation {
  double c = 1.0;
  Complex s = 0.0;
};

}  // namespace

Eigen::RowVectorXd place_with_one_input(const MatrixXd& a, const Eigen::VectorXd& b,
                                        const std::vector<Complex>& poles) {
  const Index n = a.rows();
  const ControllerHessenberg form = controller_hessenberg(a, b);
  MatrixXcd h = form.h.cast<Complex>();
  Complex beta = form.beta;
  Eigen::RowVectorXcd f(n);
  std::vector<std::vector<Rotation>> rotations;
  for (Index k = 0; k < n; ++k) {
    // The problem left: rows and columns k.. of h, the input along axis k.
    const Complex pole = poles[static_cast<std::size_t>(k)];
    const Index size = n - k;
    auto left = h.bottomRightCorner(size, size);
    left.diagonal().array() -= pole;
    // Rotations of neighbouring columns from the last: left Q = R upper triangular, so that the
    // first column x of Q has left x along the first axis.
    auto& stage = rotations.emplace_back(static_cast<std::size_t>(size - 1));
    for (Index i = size - 1; i > 0; --i) {
      const Complex below = left(i, i - 1);
      const Complex diagonal = left(i, i);
      const double length = std::hypot(std::abs(below), std::abs(diagonal));
      Rotation& rotation = stage[static_cast<std::size_t>(i - 1)];
      if (length == 0.0) continue;
      // (below, diagonal) [c; s] = 0 with c >= 0 real.
      const double magnitude = std::abs(diagonal);
      const Complex phase = magnitude > 0.0 ? diagonal / magnitude : Complex{1.0};
      rotation.c = magnitude / length;
      rotation.s = -below * std::conj(phase) / length;
      for (Index row = 0; row <= i; ++row) {
        const Complex x = left(row, i - 1);
        const Complex y = left(row, i);
        left(row, i - 1) = rotation.c * x + rotation.s * y;
        left(row, i) = rotation.c * y - std::conj(rotation.s) * x;
      }
      left(i, i - 1) = 0.0;
    }
    f[k] = left(0, 0) / beta;
    if (size == 1) break;
    // Q^H R + pole: Hessenberg again, with x on the first axis.
    for (Index i = size - 1; i > 0; --i) {
      const Rotation& rotation = stage[static_cast<std::size_t>(i - 1)];
      for (Index column = i - 1; column < size; ++column) {
        const Complex x = left(i - 1, column);
        const Complex y = left(i, column);
        left(i - 1, column) = rotation.c * x + std::conj(rotation.s) * y;
        left(i, column) = rotation.c * y - rotation.s * x;
      }
    }
    left.diagonal().array() += pole;
    // Row 0 of Q is [c, -conj(s), 0, ...] of its last rotation.
    beta *= -stage[0].s;
  }
  // [f of x, f of the rest] back through the rotations, the last problem first.
  for (Index k = n - 2; k >= 0; --k) {
    const auto& stage = rotations[static_cast<std::size_t>(k)];
    for (Index i = 1; i < n - k; ++i) {
      const Rotation& rotation = stage[static_cast<std::size_t>(i - 1)];
      const Complex x = f[k + i - 1];
      const Complex y = f[k + i];
      f[k + i - 1] = rotation.c * x - rotation.s * y;
      f[k + i] = std::conj(rotation.s) * x + rotation.c * y;
    }
  }
  return f.real() * form.q.transpose();
}

}  // namespace boresight::control
