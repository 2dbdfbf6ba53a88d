#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/equations/schur_lyapunov.hpp>
#include <boresight/control/equations/stability_margin.hpp>
#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/real_schur.hpp>

namespace boresight::control {
namespace {

using Eigen::MatrixXd;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Equation {
  const char* function;
  TimeDomain domain;
  bool continuous() const { return domain == TimeDomain::continuous; }
};

void check_arguments(const Equation& equation, const MatrixXd& a, const MatrixXd& q) {
  const Eigen::Index n = a.rows();
  if (n == 0 || a.cols() != n || q.rows() != n || q.cols() != n) {
    throw InvalidInput(
        fmt::format("{}: expected square A and Q of one size, found {} x {} and {} x {}",
                    equation.function, a.rows(), a.cols(), q.rows(), q.cols()));
  }
  if (!a.allFinite() || !q.allFinite()) {
    throw InvalidInput(
        fmt::format("{}: A or Q has elements that are not finite", equation.function));
  }
}

MatrixXd residual_of(const Equation& equation, const MatrixXd& a, const MatrixXd& p,
                     const MatrixXd& q) {
  const MatrixXd ap = a * p;
  if (equation.continuous()) return ap + ap.transpose() + q;
  MatrixXd residual = q - p;
  residual.noalias() += ap * a.transpose();
  return residual;
}

// Largest element of the residual relative to what its own terms add up to: the same in any scale
// of the states.
double elementwise_residual(const Equation& equation, const MatrixXd& a, const MatrixXd& q,
                            const MatrixXd& p) {
  const MatrixXd magnitude = p.cwiseAbs();
  const MatrixXd product = a.cwiseAbs() * magnitude;
  MatrixXd size = q.cwiseAbs();
  if (equation.continuous()) {
    size += product + product.transpose();
  } else {
    size += product * a.cwiseAbs().transpose() + magnitude;
  }
  const MatrixXd residual = residual_of(equation, a, p, 0.5 * (q + q.transpose())).cwiseAbs();
  return (size.array() > 0.0).select(residual.array() / size.array(), 0.0).maxCoeff();
}

LyapunovSolution solve_scaled(const Equation& equation, const MatrixXd& a, const MatrixXd& q,
                              const LyapunovOptions& options, const Eigen::VectorXd& scale) {
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const MatrixXd balanced = inverse.asDiagonal() * a * scale.asDiagonal();
  const MatrixXd symmetric =
      inverse.asDiagonal() * (0.5 * (q + q.transpose())) * inverse.asDiagonal();
  const double norm_a = balanced.norm();
  const double norm_q = symmetric.norm();

  const numerics::RealSchur schur = numerics::real_schur(balanced);
  LyapunovSolution solution;
  solution.stability_margin = require_stable(
      equation.function, stability_margin(schur.t, norm_a, equation.domain), equation.domain);
  SchurLyapunov equations(schur.t, equation.domain);
  MatrixXd work = symmetric * schur.u;
  MatrixXd x = -(schur.u.transpose() * work);
  equations.solve(x);
  work.noalias() = schur.u * x;
  MatrixXd p = work * schur.u.transpose();
  p = 0.5 * (p + p.transpose()).eval();

  const double norm_p = p.norm();
  const double norm_residual = residual_of(equation, balanced, p, symmetric).norm();
  const double size =
      (equation.continuous() ? 2.0 * norm_a : norm_a * norm_a + 1.0) * norm_p + norm_q;
  solution.relative_residual = size > 0.0 ? norm_residual / size : 0.0;
  if (!(solution.relative_residual < 1e-9)) {
    throw NumericalFailure(fmt::format("{}: relative residual {:.1e} exceeds 1e-9",
                                       equation.function, solution.relative_residual));
  }
  if (options.estimate_condition && norm_p > 0.0) {
    MatrixXd unit = -MatrixXd::Identity(a.rows(), a.rows());
    equations.solve(unit);
    const double inverse_separation = symmetric_norm(unit);
    const double spectral_p = symmetric_norm(p);
    const double factor = equation.continuous() ? 2.0 * norm_a : 2.0 * norm_a * norm_a;
    solution.condition = inverse_separation * (factor + norm_q / spectral_p);
    solution.error_bound = inverse_separation * (norm_residual + epsilon * size) / spectral_p;
  }
  solution.covariance = scale.asDiagonal() * p * scale.asDiagonal();
  return solution;
}

LyapunovSolution solve(const Equation& equation, const MatrixXd& a, const MatrixXd& q,
                       const LyapunovOptions& options) {
  check_arguments(equation, a, q);
  const Eigen::VectorXd scale = numerics::balancing_scale(a);
  LyapunovSolution balanced = solve_scaled(equation, a, q, options, scale);
  // Couplings that are rounding errors draw the scales of balancing apart: the states as given may
  // then be the better ones. No residual in norms tells.
  constexpr double usual_spread = 0x1p40;
  if (scale.maxCoeff() < usual_spread * scale.minCoeff()) return balanced;
  LyapunovSolution plain;
  try {
    plain = solve_scaled(equation, a, q, options, Eigen::VectorXd::Ones(scale.size()));
  } catch (const NumericalFailure&) {
    return balanced;
  }
  return elementwise_residual(equation, a, q, plain.covariance) <
                 elementwise_residual(equation, a, q, balanced.covariance)
             ? plain
             : balanced;
}

}  // namespace

LyapunovSolution solve_lyapunov(const MatrixXd& a, const MatrixXd& q,
                                const LyapunovOptions& options) {
  return solve({"solve_lyapunov", TimeDomain::continuous}, a, q, options);
}

LyapunovSolution solve_discrete_lyapunov(const MatrixXd& a, const MatrixXd& q,
                                         const LyapunovOptions& options) {
  return solve({"solve_discrete_lyapunov", TimeDomain::sampled}, a, q, options);
}

}  // namespace boresight::control
