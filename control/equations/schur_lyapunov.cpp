#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/equations/schur_lyapunov.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

// Whether rows k-1 and k share a 2 x 2 block of T.
bool paired(const MatrixXd& t, Index k) {
  return k > 0 && t(k, k - 1) != 0.0;
}

}  // namespace

SchurLyapunov::SchurLyapunov(MatrixXd t, TimeDomain domain)
    : domain_(domain), t_(std::move(t)), column_(t_.rows(), 2), known_(t_.rows(), 2) {
  if (t_.rows() != t_.cols()) {
    throw InvalidInput(fmt::format("SchurLyapunov: expected a square matrix, found {} x {}",
                                   t_.rows(), t_.cols()));
  }
}

void SchurLyapunov::solve(MatrixXd& c) {
  solve_upper(t_, c);
}

void SchurLyapunov::solve_transposed(MatrixXd& c) {
  // Reversing rows and columns makes T' upper quasi-triangular again.
  if (flipped_.size() != t_.size()) flipped_ = t_.transpose().reverse();
  c.reverseInPlace();
  solve_upper(flipped_, c);
  c.reverseInPlace();
}

// Leaves in column_.topRows(j + width) what T11 x + x Tjj' (T11 x Tjj' - x) must be, T11 the first
// j + width rows and columns of T, Tjj the block at j.
void SchurLyapunov::right_hand_side(const MatrixXd& t, const MatrixXd& c, Index j, Index width) {
  const Index end = j + width;
  const Index later = t.rows() - end;
  for (Index k = 0; k < width; ++k) {
    auto column = column_.col(k).head(end);
    column = c.col(j + k).head(end);
    if (later == 0) continue;
    const auto row = t.row(j + k).tail(later).transpose();
    if (domain_ == TimeDomain::continuous) {
      column.noalias() -= c.topRightCorner(end, later) * row;
      column.noalias() -= t.topRightCorner(end, later) * c.col(j + k).tail(later);
    } else {
      auto known = known_.col(k);
      known.noalias() = c.rightCols(later) * row;
      for (Index i = 0; i < width; ++i) {
        known.tail(later) += t(j + k, j + i) * c.col(j + i).tail(later);
      }
      column.noalias() -=
          t.topRows(end).leftCols(end).triangularView<Eigen::Upper>() * known.head(end);
      for (Index i = 1; i < end; ++i) column[i] -= t(i, i - 1) * known[i - 1];
      column.noalias() -= t.topRightCorner(end, later) * known.tail(later);
    }
  }
}

// Solves (T11 + shift) x = column_.col(0), or (shift T11 - 1) x = it, from the last row.
void SchurLyapunov::substitute_real(const MatrixXd& t, Index rows, double shift) {
  const bool continuous = domain_ == TimeDomain::continuous;
  const double factor = continuous ? 1.0 : shift;
  const double addend = continuous ? shift : -1.0;
  auto x = column_.col(0);
  for (Index i = rows - 1; i >= 0; --i) {
    const double diagonal = factor * t(i, i) + addend;
    if (!paired(t, i)) {
      x[i] /= diagonal;
      x.head(i) -= (factor * x[i]) * t.col(i).head(i);
      continue;
    }
    --i;
    // [diagonal b; c diagonal] with b c < 0.
    const double b = factor * t(i, i + 1);
    const double c = factor * t(i + 1, i);
    const double determinant = diagonal * diagonal - b * c;
    const double upper = (diagonal * x[i] - b * x[i + 1]) / determinant;
    const double lower = (diagonal * x[i + 1] - c * x[i]) / determinant;
    x[i] = upper;
    x[i + 1] = lower;
    x.head(i) -= (factor * upper) * t.col(i).head(i) + (factor * lower) * t.col(i + 1).head(i);
  }
}

// The same for the complex column column_.col(0) + j column_.col(1).
void SchurLyapunov::substitute_complex(const MatrixXd& t, Index rows, double shift_real,
                                       double shift_imaginary) {
  const bool continuous = domain_ == TimeDomain::continuous;
  const Complex shift{shift_real, shift_imaginary};
  const Complex factor = continuous ? Complex{1.0} : shift;
  const Complex addend = continuous ? shift : Complex{-1.0};
  auto real = column_.col(0);
  auto imaginary = column_.col(1);
  for (Index i = rows - 1; i >= 0; --i) {
    const Complex diagonal = factor * t(i, i) + addend;
    if (!paired(t, i)) {
      const Complex x = Complex{real[i], imaginary[i]} / diagonal;
      real[i] = x.real();
      imaginary[i] = x.imag();
      const Complex y = factor * x;
      real.head(i) -= y.real() * t.col(i).head(i);
      imaginary.head(i) -= y.imag() * t.col(i).head(i);
      continue;
    }
    --i;
    const Complex b = factor * t(i, i + 1);
    const Complex c = factor * t(i + 1, i);
    const Complex upper{real[i], imaginary[i]};
    const Complex lower{real[i + 1], imaginary[i + 1]};
    // As a product: nothing cancels where an eigenvalue is near.
    const double frequency = std::sqrt(std::abs(t(i, i + 1))) * std::sqrt(std::abs(t(i + 1, i)));
    const Complex offset = factor * Complex{0.0, frequency};
    const Complex inverse = 1.0 / ((diagonal + offset) * (diagonal - offset));
    const Complex x = (diagonal * upper - b * lower) * inverse;
    const Complex z = (diagonal * lower - c * upper) * inverse;
    real[i] = x.real();
    imaginary[i] = x.imag();
    real[i + 1] = z.real();
    imaginary[i + 1] = z.imag();
    const Complex fx = factor * x;
    const Complex fz = factor * z;
    real.head(i) -= fx.real() * t.col(i).head(i) + fz.real() * t.col(i + 1).head(i);
    imaginary.head(i) -= fx.imag() * t.col(i).head(i) + fz.imag() * t.col(i + 1).head(i);
  }
}

void SchurLyapunov::solve_upper(const MatrixXd& t, MatrixXd& c) {
  const Index n = t.rows();
  if (c.rows() != n || c.cols() != n) {
    throw InvalidInput(
        fmt::format("SchurLyapunov: expected a right-hand side of {} x {}, found {} x {}", n, n,
                    c.rows(), c.cols()));
  }
  for (Index end = n; end > 0;) {
    const Index width = paired(t, end - 1) ? 2 : 1;
    const Index j = end - width;
    right_hand_side(t, c, j, width);
    if (width == 1) {
      substitute_real(t, end, t(j, j));
      c.col(j).head(end) = column_.col(0).head(end);
    } else {
      // [x1 x2] Tjj' = [a x1 + b x2, c x1 + a x2] for Tjj = [a b; c a]: x1 + j r x2 with
      // r = sqrt(-b/c) goes over into (a + j r c) times itself.
      const double ratio = std::sqrt(std::abs(t(j, j + 1))) / std::sqrt(std::abs(t(j + 1, j)));
      column_.col(1).head(end) *= ratio;
      substitute_complex(t, end, t(j, j), ratio * t(j + 1, j));
      c.col(j).head(end) = column_.col(0).head(end);
      c.col(j + 1).head(end) = column_.col(1).head(end) / ratio;
      const double mean = 0.5 * (c(j, j + 1) + c(j + 1, j));
      c(j, j + 1) = mean;
      c(j + 1, j) = mean;
    }
    c.block(j, 0, width, j) = c.block(0, j, j, width).transpose();
    end = j;
  }
}

double symmetric_norm(const MatrixXd& matrix) {
  if (matrix.size() == 0) return 0.0;
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (scale == 0.0 || !std::isfinite(scale)) return scale;
  Index start = 0;
  (matrix / scale).colwise().squaredNorm().maxCoeff(&start);
  Eigen::VectorXd image = matrix.col(start) / scale;
  Eigen::VectorXd direction(image.size());
  double norm = image.norm();
  constexpr int steps = 12;
  for (int i = 0; i < steps; ++i) {
    direction = image / (image.norm() * scale);
    image.noalias() = matrix * direction;
    norm = std::max(norm, image.norm());
  }
  return norm * scale;
}

}  // namespace boresight::control
