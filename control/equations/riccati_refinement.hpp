#pragma once

#include <Eigen/Core>

#include <boresight/control/equations/riccati_doubling.hpp>
#include <boresight/control/equations/schur_lyapunov.hpp>
#include <boresight/control/equations/stability_margin.hpp>

namespace boresight::control {

/// A solution of a Riccati equation after Newton's method.
struct RiccatiRefinement {
  Eigen::MatrixXd x;
  Eigen::VectorXcd eigenvalues;  // of the closed loop, unsorted
  StabilityMargin margin;        // of the closed loop
  double residual = 0.0;         // Frobenius norm
  double terms = 0.0;            // norm of its terms with every element taken positive
  double condition = 0.0;        // as RiccatiSolution
  double error_bound = 0.0;
  int steps = 0;
};

/// Newton's method from a solution X whose closed loop (A - G X, or (1 + G X)^-1 A) is stable. Each
/// step solves the Lyapunov equation of the closed loop for the residual, until the correction is
/// below 1e-12 of X or no longer halves. If the closed loop is not stable, the margin of the result
/// states so and X is unchanged. `input`: F with F F' = G.
RiccatiRefinement refine_riccati(const RiccatiMatrices& matrices, const Eigen::MatrixXd& input,
                                 Eigen::MatrixXd x, TimeDomain domain, bool estimate_condition);

}  // namespace boresight::control
