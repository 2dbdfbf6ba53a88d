#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/control/equations/mode_distance.hpp>
#include <boresight/control/equations/riccati.hpp>
#include <boresight/control/equations/riccati_doubling.hpp>
#include <boresight/control/equations/riccati_refinement.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/real_schur.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

struct Equation {
  const char* function;
  TimeDomain domain;
  bool continuous() const { return domain == TimeDomain::continuous; }
  std::string name(const char* argument) const { return fmt::format("{}: {}", function, argument); }
};

void check_shapes(const Equation& equation, const RiccatiProblem& problem) {
  const Index n = problem.a.rows();
  const Index inputs = problem.b.cols();
  const auto check = [&](const char* name, const MatrixXd& matrix, Index rows, Index columns) {
    if (matrix.rows() != rows || matrix.cols() != columns) {
      throw InvalidInput(fmt::format("{}: expected {} as {} x {}, found {} x {}", equation.function,
                                     name, rows, columns, matrix.rows(), matrix.cols()));
    }
    if (!matrix.allFinite()) {
      throw InvalidInput(
          fmt::format("{}: {} has elements that are not finite", equation.function, name));
    }
  };
  if (n == 0 || inputs == 0) {
    throw InvalidInput(fmt::format("{}: expected at least one state and one input, found {} and {}",
                                   equation.function, n, inputs));
  }
  check("A", problem.a, n, n);
  check("B", problem.b, n, inputs);
  check("Q", problem.q, n, n);
  check("R", problem.r, inputs, inputs);
  if (problem.s.size() > 0) check("S", problem.s, n, inputs);
}

// The problem with inputs in units in which R is the identity, u = W'v with R^-1 = W'W, and
// without its cross term: G = input input', Q = weight weight'.
struct Reduced {
  RiccatiMatrices matrices;
  MatrixXd input;
  MatrixXd cross;  // S in those units; empty if there is none
  MatrixXd weight;
  MatrixXd unit;  // W
};

Reduced reduce(const Equation& equation, const RiccatiProblem& problem) {
  check_shapes(equation, problem);
  const Index inputs = problem.r.rows();
  const MatrixXd root = numerics::semidefinite_factor(problem.r, equation.name("R").c_str());
  if (root.cols() < inputs) {
    throw InvalidInput(
        fmt::format("{}: expected R positive definite, found it of rank {} for {} inputs; every "
                    "input needs a weight",
                    equation.function, root.cols(), inputs));
  }
  // W = root^-1, rows of R in units of their own.
  const Eigen::VectorXd scale = problem.r.diagonal().cwiseSqrt().cwiseInverse();
  Reduced result;
  result.unit = numerics::linear_solve(scale.asDiagonal() * root,
                                       scale.asDiagonal().toDenseMatrix(), equation.function);
  result.input = problem.b * result.unit.transpose();
  result.matrices.a = problem.a;
  result.matrices.g = result.input * result.input.transpose();
  result.matrices.q = 0.5 * (problem.q + problem.q.transpose());
  const char* weight = "Q";
  if (problem.s.size() > 0) {
    result.cross = problem.s * result.unit.transpose();
    result.matrices.a.noalias() -= result.input * result.cross.transpose();
    result.matrices.q.noalias() -= result.cross * result.cross.transpose();
    weight = "Q - S R^-1 S'";
  }
  result.weight = numerics::semidefinite_factor(
      problem.s.size() > 0 ? result.matrices.q : problem.q, equation.name(weight).c_str());
  return result;
}

[[noreturn]] void refuse(const Equation& equation, const char* what, const char* pair,
                         const std::vector<ModeDistance::Mode>& modes, const char* remedy) {
  std::string list;
  for (const auto& mode : modes) {
    list += (list.empty() ? "" : ", ") + describe_eigenvalue(mode.eigenvalue);
  }
  throw NumericalFailure(fmt::format("{}: {} is not {}: eigenvalue{} {} of A; {}",
                                     equation.function, pair, what, modes.size() == 1 ? "" : "s",
                                     list, remedy));
}

// Refuses what has no stabilising solution; returns the eigenvalues of A. `scale`: the states'
// units.
Eigen::VectorXcd require_solvable(const Equation& equation, const Reduced& reduced,
                                  const Eigen::VectorXd& scale) {
  constexpr double tolerance = 1e-12;
  const MatrixXd a = scale.cwiseInverse().asDiagonal() * reduced.matrices.a * scale.asDiagonal();
  const double norm = a.norm();
  const numerics::RealSchur schur = numerics::real_schur(a);
  Eigen::VectorXcd eigenvalues = numerics::schur_eigenvalues(schur.t);
  const StabilityMargin margin = stability_margin(schur.t, norm, equation.domain);
  if (margin.value > 10.0 * margin.rounding) return eigenvalues;

  ModeDistance from_inputs(schur, scale.cwiseInverse().asDiagonal() * reduced.input, norm,
                           equation.domain);
  const auto unreached =
      confirm_unreached(from_inputs.unreached_unstable(tolerance), reduced.matrices.a,
                        reduced.input, equation.domain, tolerance);
  if (!unreached.empty()) {
    refuse(equation, "stabilisable", "(A, B)", unreached,
           "no input reaches what is not stable: remove those states or add an input");
  }
  ModeDistance from_weight(numerics::transposed(schur), scale.asDiagonal() * reduced.weight, norm,
                           equation.domain);
  const auto unseen =
      confirm_unreached(from_weight.unreached_unstable(tolerance), reduced.matrices.a.transpose(),
                        reduced.weight, equation.domain, tolerance);
  if (!unseen.empty()) {
    refuse(equation, "detectable",
           reduced.cross.size() > 0 ? "(A - B R^-1 S', Q - S R^-1 S')" : "(A, Q)", unseen,
           "the weight does not see what is not stable: weight those states");
  }
  return eigenvalues;
}

// Parameter c of the Cayley transform. It takes an eigenvalue -d +- j w of the closed loop to
// magnitude^2 1 - 4 c d/((c + d)^2 + w^2): the c at which the slowest to converge does best. The
// eigenvalues of A stand in for those of the closed loop, beside the speed that the weights ask
// for.
double cayley_parameter(const RiccatiMatrices& scaled, const Eigen::VectorXcd& eigenvalues) {
  const double demanded = std::sqrt((scaled.g * scaled.q).norm());
  const double largest = eigenvalues.cwiseAbs().maxCoeff();
  const double fastest = std::max(largest, demanded);
  if (fastest == 0.0) return 1.0;
  constexpr double min_damping_ratio = 1e-3;
  // Integrators and what else is slower still: the closed loop will have moved it.
  const double slow = 1e-6 * (largest > 0.0 ? largest : fastest);
  const auto convergence = [&](double c) {
    double minimum = std::numeric_limits<double>::infinity();
    for (const Complex eigenvalue : eigenvalues) {
      const double magnitude = std::abs(eigenvalue);
      if (magnitude < slow) continue;
      const double damping = std::max(std::abs(eigenvalue.real()), min_damping_ratio * magnitude);
      const double sum = c + damping;
      minimum =
          std::min(minimum, c * damping / (sum * sum + eigenvalue.imag() * eigenvalue.imag()));
    }
    if (demanded == 0.0) return minimum;
    return std::min(minimum, c * demanded / ((c + demanded) * (c + demanded)));
  };
  double best = fastest;
  double best_convergence = convergence(best);
  for (double c = 0.6 * fastest; c > slow; c *= 0.6) {
    const double here = convergence(c);
    if (here > best_convergence) {
      best = c;
      best_convergence = here;
    }
  }
  return best;
}

struct Attempt {
  int doublings = 0;  // 0 if they did not converge; then there is no refinement
  RiccatiRefinement refinement;

  bool good() const {
    return doublings > 0 && refinement.margin.stable() &&
           refinement.residual <= 1e-9 * refinement.terms;
  }
};

Attempt attempt(const std::optional<RiccatiMatrices>& sampled, const RiccatiMatrices& scaled,
                const MatrixXd& input, TimeDomain domain, bool estimate_condition) {
  if (!sampled) return {};
  auto doubling = solve_by_doubling(*sampled);
  if (!doubling) return {};
  return {doubling->doublings,
          refine_riccati(scaled, input, std::move(doubling->x), domain, estimate_condition)};
}

[[noreturn]] void fail(const Equation& equation, const Attempt& last) {
  std::string found = "the doubling iteration did not converge";
  if (last.doublings > 0) {
    const StabilityMargin& margin = last.refinement.margin;
    found = margin.stable()
                ? fmt::format("the residual stays at {:.1e} of the terms",
                              last.refinement.residual / last.refinement.terms)
                : fmt::format(
                      "the closed loop found has a stability margin of {:.1e}, not above "
                      "rounding ({:.1e})",
                      margin.value, margin.rounding);
  }
  throw NumericalFailure(
      fmt::format("{}: no stabilising solution: {}; weight or drive its slowest modes more, or "
                  "sample less finely",
                  equation.function, found));
}

// K = W'(F'X + S'), sampled W'(1 + F'X F)^-1 (F'X A + S').
MatrixXd gain_of(const Equation& equation, const MatrixXd& a, const Reduced& reduced,
                 const MatrixXd& x) {
  const MatrixXd fx = reduced.input.transpose() * x;
  MatrixXd gain = equation.continuous() ? fx : MatrixXd(fx * a);
  if (reduced.cross.size() > 0) gain += reduced.cross.transpose();
  if (!equation.continuous()) {
    MatrixXd weight = fx * reduced.input;
    weight.diagonal().array() += 1.0;
    gain = numerics::positive_definite_solve(weight, gain, equation.function);
  }
  return reduced.unit.transpose() * gain;
}

void sort(Eigen::VectorXcd& eigenvalues) {
  std::stable_sort(eigenvalues.data(), eigenvalues.data() + eigenvalues.size(),
                   [](Complex left, Complex right) {
                     const double a = std::abs(left);
                     const double b = std::abs(right);
                     return a != b ? a < b : left.imag() < right.imag();
                   });
}

RiccatiSolution solve(const Equation& equation, const RiccatiProblem& problem,
                      const RiccatiOptions& options) {
  const Reduced reduced = reduce(equation, problem);
  const Eigen::VectorXd scale = riccati_scale(reduced.matrices);
  const Eigen::VectorXcd open_loop = require_solvable(equation, reduced, scale);
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const RiccatiMatrices scaled{inverse.asDiagonal() * reduced.matrices.a * scale.asDiagonal(),
                               inverse.asDiagonal() * reduced.matrices.g * inverse.asDiagonal(),
                               scale.asDiagonal() * reduced.matrices.q * scale.asDiagonal()};
  const MatrixXd input = inverse.asDiagonal() * reduced.input;
  Attempt found;
  if (equation.continuous()) {
    const double parameter = cayley_parameter(scaled, open_loop);
    // The transform breaks down where the parameter is an eigenvalue of A: another is as good.
    for (const double factor : {1.0, 3.7, 0.21, 29.0, 0.03}) {
      found = attempt(cayley_transform(scaled, factor * parameter), scaled, input, equation.domain,
                      options.estimate_condition);
      if (found.good()) break;
    }
  } else {
    found = attempt(scaled, scaled, input, equation.domain, options.estimate_condition);
  }
  if (!found.good()) fail(equation, found);
  RiccatiSolution solution;
  RiccatiRefinement& refinement = found.refinement;
  solution.x = inverse.asDiagonal() * refinement.x * inverse.asDiagonal();
  solution.gain = gain_of(equation, problem.a, reduced, solution.x);
  solution.eigenvalues = std::move(refinement.eigenvalues);
  sort(solution.eigenvalues);
  solution.stability_margin = refinement.margin.value;
  solution.relative_residual =
      refinement.terms > 0.0 ? refinement.residual / refinement.terms : 0.0;
  solution.condition = refinement.condition;
  solution.error_bound = refinement.error_bound;
  solution.doublings = found.doublings;
  solution.newton_steps = refinement.steps;
  return solution;
}

}  // namespace

RiccatiSolution solve_riccati(const RiccatiProblem& problem, const RiccatiOptions& options) {
  return solve({"solve_riccati", TimeDomain::continuous}, problem, options);
}

RiccatiSolution solve_discrete_riccati(const RiccatiProblem& problem,
                                       const RiccatiOptions& options) {
  return solve({"solve_discrete_riccati", TimeDomain::sampled}, problem, options);
}

}  // namespace boresight::control
