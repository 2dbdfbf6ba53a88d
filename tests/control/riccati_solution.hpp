#pragma once

#include <gtest/gtest.h>

#include <boresight/control/equations/riccati.hpp>
#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/eigenvalues.hpp>

namespace boresight::control {

inline RiccatiSolution solve(const RiccatiProblem& problem, bool sampled,
                             const RiccatiOptions& options = {}) {
  return sampled ? solve_discrete_riccati(problem, options) : solve_riccati(problem, options);
}

// What any solution must be: symmetric, semidefinite, stabilising, and of small residual in the
// problem's own units.
inline void expect_solution(const RiccatiProblem& problem, bool sampled,
                            const RiccatiSolution& solution, double tolerance = 1e-11) {
  const auto& [a, b, q, r, s] = problem;
  const Eigen::MatrixXd cross = s.size() > 0 ? s : Eigen::MatrixXd::Zero(b.rows(), b.cols());
  const Eigen::MatrixXd& x = solution.x;
  EXPECT_EQ((x - x.transpose()).norm(), 0.0);
  EXPECT_GE(numerics::eigenvalues(x).real().minCoeff(), -1e-12 * x.norm());
  const Eigen::MatrixXd closed = a - b * solution.gain;
  if (sampled) {
    EXPECT_LT(numerics::eigenvalues(closed).cwiseAbs().maxCoeff(), 1.0);
  } else {
    const Eigen::VectorXd scale = numerics::balancing_scale(closed);
    EXPECT_LT(numerics::spectral_abscissa(scale.cwiseInverse().asDiagonal() * closed *
                                          scale.asDiagonal()),
              0.0);
  }
  EXPECT_GT(solution.stability_margin, 0.0);
  const Eigen::MatrixXd k = solution.gain;
  // The cost of u = -K x is x'Xx (sum of terms of one sign: nothing cancels).
  const Eigen::MatrixXd cost =
      q - cross * k - k.transpose() * cross.transpose() + k.transpose() * r * k;
  const Eigen::MatrixXd lyapunov =
      sampled ? Eigen::MatrixXd(closed.transpose() * x * closed - x + cost)
              : Eigen::MatrixXd(closed.transpose() * x + x * closed + cost);
  const double size = sampled ? x.norm() * (1.0 + closed.squaredNorm()) + cost.norm()
                              : 2.0 * (x * closed).norm() + cost.norm();
  EXPECT_LT(lyapunov.norm(), tolerance * size);
  EXPECT_LT(solution.relative_residual, 1e-13);
}

}  // namespace boresight::control
