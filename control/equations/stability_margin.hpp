#pragma once

#include <string>

#include <Eigen/Core>

#include <boresight/control/equations/schur_lyapunov.hpp>

namespace boresight::control {

/// Distance of a system from its stability boundary.
struct StabilityMargin {
  /// -max Re(eigenvalue), 1/s; in sampled time 1 - max |eigenvalue|; infinity without states.
  double value = 0.0;
  /// Possible rounding error of an eigenvalue, n eps |A| (n eps).
  double rounding = 0.0;

  bool stable() const { return value > rounding; }
};

/// `t`: real Schur form of A; `norm`: |A|, Frobenius.
StabilityMargin stability_margin(const Eigen::MatrixXd& t, double norm, TimeDomain domain);

/// The value of the margin. @throws NumericalFailure, naming `function`, if the system is not
/// stable.
double require_stable(const char* function, const StabilityMargin& margin, TimeDomain domain);

/// Text that states the position of the eigenvalue that makes the system not stable.
std::string describe_instability(const StabilityMargin& margin, TimeDomain domain);

}  // namespace boresight::control
