#include <cmath>
#include <limits>
#include <utility>

#include <boresight/control/equations/riccati_refinement.hpp>
#include <boresight/numerics/real_schur.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::control {
namespace {

using Eigen::MatrixXd;

// The closed loop and the residual of the equation at X.
struct Linearisation {
  MatrixXd closed_loop;
  MatrixXd image;  // X, or X times the closed loop: what changes of A are multiplied by
  MatrixXd residual;
  double terms = 0.0;
};

// F in place of G = F F': X G X as (X F)(X F)' loses half the digits that two products would where
// X is badly conditioned.
Linearisation linearise(const RiccatiMatrices& matrices, const MatrixXd& input, const MatrixXd& x,
                        TimeDomain domain) {
  const MatrixXd& a = matrices.a;
  const MatrixXd xf = x * input;
  const MatrixXd positive_x = x.cwiseAbs();
  Linearisation result;
  result.closed_loop = a;
  if (domain == TimeDomain::continuous) {
    result.closed_loop.noalias() -= input * xf.transpose();
    result.image = x;
    const MatrixXd xa = x * a;
    result.residual = xa + xa.transpose() + matrices.q;
    result.residual.noalias() -= xf * xf.transpose();
    const MatrixXd xa_terms = positive_x * a.cwiseAbs();
    const MatrixXd xf_terms = positive_x * input.cwiseAbs();
    result.terms = 2.0 * xa_terms.norm() + 2.0 * (xf_terms * xf.cwiseAbs().transpose()).norm() +
                   matrices.q.norm();
    return result;
  }
  // (1 + F F'X)^-1 A without the inverse, whose condition grows with the gain.
  MatrixXd weight = input.transpose() * xf;
  weight = 0.5 * (weight + weight.transpose()).eval();
  weight.diagonal().array() += 1.0;
  const MatrixXd xfa = xf.transpose() * a;
  result.closed_loop.noalias() -=
      input * numerics::positive_definite_solve(weight, xfa, "solve_discrete_riccati");
  result.image = x * result.closed_loop;
  const MatrixXd axa = a.transpose() * result.image;
  result.residual = 0.5 * (axa + axa.transpose()) - x + matrices.q;
  const MatrixXd image_terms = positive_x * result.closed_loop.cwiseAbs();
  result.terms = (a.cwiseAbs().transpose() * image_terms).norm() + x.norm() + matrices.q.norm();
  return result;
}

// Solves the closed loop's Lyapunov equation L(Z) + C = 0 with
// L(Z) = F'Z + Z F, or F'Z F - Z.
class ClosedLoopEquation {
 public:
  ClosedLoopEquation(const MatrixXd& closed_loop, TimeDomain domain)
      : schur_(numerics::real_schur(closed_loop)),
        norm_(closed_loop.norm()),
        equations_(schur_.t, domain),
        domain_(domain) {}

  Eigen::VectorXcd eigenvalues() const { return numerics::schur_eigenvalues(schur_.t); }
  StabilityMargin margin() const { return stability_margin(schur_.t, norm_, domain_); }
  MatrixXd solve(const MatrixXd& c) {
    MatrixXd z = in_schur_coordinates(c);
    equations_.solve_transposed(z);
    const MatrixXd uz = schur_.u * z;
    return uz * schur_.u.transpose();
  }
  // The 2-norm of the solution for C, which needs no way back.
  double norm_of_solution(const MatrixXd& c) {
    MatrixXd z = in_schur_coordinates(c);
    equations_.solve_transposed(z);
    return symmetric_norm(z);
  }

 private:
  MatrixXd in_schur_coordinates(const MatrixXd& c) const {
    const MatrixXd cu = c * schur_.u;
    return -(schur_.u.transpose() * cu);
  }

  numerics::RealSchur schur_;
  double norm_;
  SchurLyapunov equations_;
  TimeDomain domain_;
};

}  // namespace

RiccatiRefinement refine_riccati(const RiccatiMatrices& matrices, const MatrixXd& input, MatrixXd x,
                                 TimeDomain domain, bool estimate_condition) {
  RiccatiRefinement result;
  constexpr int max_steps = 20;
  double previous = std::numeric_limits<double>::infinity();
  Linearisation at = linearise(matrices, input, x, domain);
  for (int step = 1; step <= max_steps; ++step) {
    ClosedLoopEquation equation(at.closed_loop, domain);
    result.margin = equation.margin();
    result.eigenvalues = equation.eigenvalues();
    if (!result.margin.stable()) break;
    const MatrixXd correction = equation.solve(at.residual);
    const double size = correction.norm();
    if (!std::isfinite(size)) break;
    result.steps = step;
    x += 0.5 * (correction + correction.transpose());
    at = linearise(matrices, input, x, domain);
    const double norm = x.norm();
    // Far from the solution a step may gain less than a half; near it, that is rounding.
    if (size > 1e-12 * norm && (size < 0.5 * previous || size > 1e-4 * norm) && step < max_steps) {
      previous = size;
      continue;
    }
    result.residual = at.residual.norm();
    result.terms = at.terms;
    if (estimate_condition && norm > 0.0) {
      const double separation = equation.norm_of_solution(MatrixXd::Identity(x.rows(), x.rows()));
      const MatrixXd square = at.image.transpose() * at.image;
      const double image = equation.norm_of_solution(square);
      const double spectral = symmetric_norm(x);
      result.condition =
          (separation * matrices.q.norm() +
           2.0 * std::sqrt(separation * image) * matrices.a.norm() + image * matrices.g.norm()) /
          spectral;
      result.error_bound =
          separation * (result.residual + std::numeric_limits<double>::epsilon() * result.terms) /
          spectral;
    }
    break;
  }
  result.x = std::move(x);
  return result;
}

}  // namespace boresight::control
