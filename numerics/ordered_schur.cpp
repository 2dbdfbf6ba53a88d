#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/ordered_schur.hpp>

namespace boresight::numerics {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

// Exchanges the eigenvalues at k and k + 1.
void exchange(ComplexSchur& schur, Index k) {
  MatrixXcd& t = schur.t;
  const Complex upper = t(k, k);
  const Complex lower = t(k + 1, k + 1);
  // The eigenvector of the lower one becomes the first basis vector.
  Complex x = t(k, k + 1);
  Complex y = lower - upper;
  const double length = std::hypot(std::abs(x), std::abs(y));
  if (length == 0.0) return;
  x /= length;
  y /= length;
  const auto columns = [&](MatrixXcd& m, Index rows) {
    for (Index i = 0; i < rows; ++i) {
      const Complex left = m(i, k);
      const Complex right = m(i, k + 1);
      m(i, k) = x * left + y * right;
      m(i, k + 1) = std::conj(x) * right - std::conj(y) * left;
    }
  };
  columns(t, k + 2);
  columns(schur.u, schur.u.rows());
  for (Index j = k; j < t.cols(); ++j) {
    const Complex above = t(k, j);
    const Complex below = t(k + 1, j);
    t(k, j) = std::conj(x) * above + std::conj(y) * below;
    t(k + 1, j) = x * below - y * above;
  }
  t(k, k) = lower;
  t(k + 1, k + 1) = upper;
  t(k + 1, k) = 0.0;
}

}  // namespace

Index order_schur(ComplexSchur& schur, const std::function<bool(Complex)>& first) {
  Index leading = 0;
  for (Index i = 0; i < schur.t.rows(); ++i) {
    if (!first(schur.t(i, i))) continue;
    for (Index k = i; k > leading; --k) exchange(schur, k - 1);
    ++leading;
  }
  return leading;
}

MatrixXcd decoupling(const MatrixXcd& t, Index leading) {
  const Index trailing = t.rows() - leading;
  MatrixXcd y = -t.topRightCorner(leading, trailing);
  for (Index j = 0; j < trailing; ++j) {
    const Complex shift = t(leading + j, leading + j);
    auto column = y.col(j);
    for (Index k = 0; k < j; ++k) column += t(leading + k, leading + j) * y.col(k);
    for (Index i = leading - 1; i >= 0; --i) {
      const Complex difference = t(i, i) - shift;
      if (difference == 0.0) {
        throw NumericalFailure(
            fmt::format("decoupling: expected groups without a common eigenvalue, found {} + {} j "
                        "in both",
                        shift.real(), shift.imag()));
      }
      column[i] /= difference;
      column.head(i) -= column[i] * t.col(i).head(i);
    }
  }
  return y;
}

}  // namespace boresight::numerics
