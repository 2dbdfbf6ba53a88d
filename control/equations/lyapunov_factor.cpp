#include <cmath>
#include <complex>
#include <utility>

#include <Eigen/QR>
#include <fmt/format.h>

#include <boresight/control/equations/lyapunov_factor.hpp>
#include <boresight/control/equations/stability_margin.hpp>
#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/real_schur.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

// Solves (factor T11 + addend) x = x in place, T11 the first x.size() rows and columns of T.
void substitute(const MatrixXcd& t, Complex factor, Complex addend,
                Eigen::Ref<Eigen::VectorXcd> x) {
  for (Index i = x.size() - 1; i >= 0; --i) {
    x[i] /= factor * t(i, i) + addend;
    x.head(i) -= (factor * x[i]) * t.col(i).head(i);
  }
}

}  // namespace

// With T = [T1 t; 0 l], U = [U1 u; 0 v], b = [B1; d] and a = d/v the last row and column of
// the equation give v and u, and what is left for T1 and U1 is the same equation with
//   continuous  v = |d|/sqrt(-2 Re l),     (T1 + conj(l)) u = -(v t + B1 a^H),  B1 <- B1 - u a
//   sampled     v = |d|/sqrt(1 - |l|^2),   (1 - conj(l) T1) u = conj(l) v t + B1 a^H,
//               B1 <- B1 - (B1 a^H/(1 + |l|) + conj(l)/|l| (T1 u + v t)) a.
MatrixXcd triangular_lyapunov_factor(const MatrixXcd& t, MatrixXcd b, TimeDomain domain) {
  const Index n = t.rows();
  if (t.cols() != n || b.rows() != n) {
    throw InvalidInput(fmt::format(
        "triangular_lyapunov_factor: expected a square T and as many rows of B, found {} x {} and "
        "{}",
        n, t.cols(), b.rows()));
  }
  MatrixXcd factor = MatrixXcd::Zero(n, n);
  Eigen::RowVectorXcd direction(b.cols());
  Eigen::VectorXcd projection(n);
  Eigen::VectorXcd image(n);
  for (Index j = n - 1; j >= 0; --j) {
    const Complex eigenvalue = t(j, j);
    const double magnitude = std::abs(eigenvalue);
    const double length = domain == TimeDomain::continuous
                              ? std::sqrt(-2.0 * eigenvalue.real())
                              : std::sqrt((1.0 - magnitude) * (1.0 + magnitude));
    const double last = b.row(j).stableNorm() / length;
    factor(j, j) = last;
    if (j == 0 || last == 0.0) continue;
    direction = b.row(j) / last;
    auto u = factor.col(j).head(j);
    projection.head(j).noalias() = b.topRows(j) * direction.adjoint();
    if (domain == TimeDomain::continuous) {
      u = -(last * t.col(j).head(j) + projection.head(j));
      substitute(t, 1.0, std::conj(eigenvalue), u);
      b.topRows(j).noalias() -= u * direction;
    } else {
      u = (std::conj(eigenvalue) * last) * t.col(j).head(j) + projection.head(j);
      substitute(t, -std::conj(eigenvalue), 1.0, u);
      image.head(j) = last * t.col(j).head(j);
      image.head(j).noalias() += t.topLeftCorner(j, j).triangularView<Eigen::Upper>() * u;
      const Complex phase = magnitude > 0.0 ? std::conj(eigenvalue) / magnitude : Complex{1.0};
      image.head(j) = projection.head(j) / (1.0 + magnitude) + phase * image.head(j);
      b.topRows(j).noalias() -= image.head(j) * direction;
    }
  }
  return factor;
}

LyapunovFactor lyapunov_factor(const char* function, const MatrixXd& a, const MatrixXd& b,
                               const Eigen::VectorXd& scale, TimeDomain domain) {
  if (a.rows() == 0 || a.cols() != a.rows() || b.rows() != a.rows() || scale.size() != a.rows()) {
    throw InvalidInput(fmt::format(
        "{}: expected a square A and as many rows of B and scales, found {} x {}, {} x {} and {}",
        function, a.rows(), a.cols(), b.rows(), b.cols(), scale.size()));
  }
  if (!a.allFinite() || !b.allFinite()) {
    throw InvalidInput(fmt::format("{}: A or B has elements that are not finite", function));
  }
  const MatrixXd balanced = scale.cwiseInverse().asDiagonal() * a * scale.asDiagonal();
  const numerics::RealSchur real = numerics::real_schur(balanced);
  LyapunovFactor result;
  result.stability_margin =
      require_stable(function, stability_margin(real.t, balanced.norm(), domain), domain);
  const numerics::ComplexSchur schur = numerics::complex_schur(real);
  const MatrixXd scaled = scale.cwiseInverse().asDiagonal() * b;
  const MatrixXcd factor = triangular_lyapunov_factor(schur.t, schur.u.adjoint() * scaled, domain);
  result.factor = scale.asDiagonal() * (schur.u * factor.triangularView<Eigen::Upper>());
  return result;
}

LyapunovFactor lyapunov_factor(const char* function, const MatrixXd& a, const MatrixXd& b,
                               TimeDomain domain) {
  return lyapunov_factor(function, a, b, numerics::balancing_scale(a), domain);
}

MatrixXd real_lyapunov_factor(const LyapunovFactor& complex) {
  // F F^H = Re F Re F' + Im F Im F', its imaginary part being 0.
  const Index n = complex.factor.rows();
  MatrixXd stacked(2 * n, n);
  stacked.topRows(n) = complex.factor.real().transpose();
  stacked.bottomRows(n) = complex.factor.imag().transpose();
  const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(stacked);
  MatrixXd upper = stacked.topRows(n).triangularView<Eigen::Upper>();
  return upper.transpose();
}

}  // namespace boresight::control
