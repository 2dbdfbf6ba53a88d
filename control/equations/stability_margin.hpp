#pragma once

#include <string>

#include <Eigen/Core>

#include <boresight/control/equations/schur_lyapunov.hpp>

namespace boresight::control {

/// How far inside its stability boundary a system is.
struct StabilityMargin {
  /// -max Re(eigenvalue), 1/s; in sampled time 1 - max |eigenvalue|; infinity without states.
  double value = 0.0;
  /// What rounding may have moved an eigenvalue by, n eps |A| (n eps).
  double rounding = 0.0;

  bool stable() const { return value > rounding; }
};

/// `t`: real Schur form of A; `norm`: |A|, Frobenius.
StabilityMargin stability_margin(const Eigen::MatrixXd& t, double norm, TimeDomain domain);

/// Its value. @throws NumericalFailure, naming `function`, if it is not stable.
double require_stable(const char* function, const StabilityMargin& margin, TimeDomain domain);

/// Says in words where the eigenvalue is that makes the system not stable.
std::string describe_instability(const StabilityMargin& margin, TimeDomain domain);

}  // namespace boresight::control
