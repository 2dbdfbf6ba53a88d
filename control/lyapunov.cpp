#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <boresight/control/lyapunov.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::control {

LyapunovSolution solve_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q) {
  const Eigen::Index n = a.rows();
  if (n == 0 || a.cols() != n || q.rows() != n || q.cols() != n) {
    throw InvalidInput(fmt::format(
        "solve_lyapunov: expected square A and Q of one size, found {} x {} and {} x {}", a.rows(),
        a.cols(), q.rows(), q.cols()));
  }
  if (!a.allFinite() || !q.allFinite()) {
    throw InvalidInput("solve_lyapunov: A or Q has elements that are not finite");
  }
  const Eigen::ComplexSchur<Eigen::MatrixXd> schur(a);
  if (schur.info() != Eigen::Success) {
    throw NumericalFailure("solve_lyapunov: the Schur iteration did not converge");
  }
  const Eigen::MatrixXcd& t = schur.matrixT();
  const Eigen::MatrixXcd& u = schur.matrixU();
  LyapunovSolution solution;
  solution.stability_margin = -t.diagonal().real().maxCoeff();
  if (!(solution.stability_margin > 1e-12 * a.norm())) {
    throw NumericalFailure(
        fmt::format("solve_lyapunov: expected the eigenvalues of A left of {:.1g} 1/s (1e-12 of "
                    "its norm), found "
                    "one at {:.3g}; remove integrators and free angles that nothing uses",
                    -1e-12 * a.norm(), -solution.stability_margin));
  }
  // T X + X T^H + U^H Q U = 0, column by column from the last.
  Eigen::MatrixXcd x = -(u.adjoint() * q * u);
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    for (Eigen::Index k = j + 1; k < n; ++k) x.col(j) -= std::conj(t(j, k)) * x.col(k);
    for (Eigen::Index i = n - 1; i >= 0; --i) {
      std::complex<double> sum = x(i, j);
      for (Eigen::Index k = i + 1; k < n; ++k) sum -= t(i, k) * x(k, j);
      x(i, j) = sum / (t(i, i) + std::conj(t(j, j)));
    }
  }
  const Eigen::MatrixXd p = (u * x * u.adjoint()).real();
  solution.covariance = 0.5 * (p + p.transpose());
  const Eigen::MatrixXd residual =
      a * solution.covariance + solution.covariance * a.transpose() + q;
  const double scale = 2.0 * a.norm() * solution.covariance.norm() + q.norm();
  solution.relative_residual = scale > 0.0 ? residual.norm() / scale : 0.0;
  if (!(solution.relative_residual < 1e-9)) {
    throw NumericalFailure(fmt::format("solve_lyapunov: relative residual {:.1e} exceeds 1e-9",
                                       solution.relative_residual));
  }
  return solution;
}

}  // namespace boresight::control
