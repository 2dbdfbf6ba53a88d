#pragma once

#include <string>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A norm, or why it is infinite.
struct H2Norm {
  double value = 0.0;  // infinity where there is a reason for it
  std::string reason;  // empty where the norm is finite
  /// -max Re(eigenvalue of A), 1/s; for a sampled system 1 - max |eigenvalue|; infinity without
  /// states.
  double stability_margin = 0.0;
};

/// The H2 norm: the root of the summed variances of the outputs for independent white noise of unit
/// intensity (sampled: unit variance) at each input,
///   sqrt(1/(2 pi) integral over w of |H(j w)|^2), Frobenius norm; sampled: over the unit circle,
/// from a factor of the covariance (lyapunov_factor.hpp), which keeps the digits of outputs that
/// see little of it: some 1e-16 times the condition of the Lyapunov equation. O(n^3).
/// Infinite, with the reason, for a continuous system with direct feedthrough and for one that is
/// not stable, seen at the outputs or not: remove states that nothing uses first.
/// @throws InvalidInput as validate(system).
H2Norm h2_norm(const plant::StateSpace& system);

/// The same integral along the axis (circle) for a system whose poles lie on either side of it:
/// the L2 norm, the root of the summed norms of the stable and the antistable part. Equal to the H2
/// norm where the system is stable. Infinite for direct feedthrough (continuous) and poles on the
/// axis (circle), to rounding.
/// @throws InvalidInput as validate(system).
H2Norm l2_norm(const plant::StateSpace& system);

/// Covariance of the outputs, or why some of its elements are infinite.
struct OutputCovariance {
  Eigen::MatrixXd covariance;  // outputs x outputs, symmetric
  std::string reason;          // empty where every element is finite
};

/// Covariance of the outputs for white noise of intensity W (inputs x inputs, symmetric positive
/// semidefinite, unit^2 s; sampled: covariance per sample, unit^2): C P C', sampled C P C' + D W
/// D'. Infinite are, for a continuous system, the elements where D W D' is not 0, and every
/// element where the system is not stable.
/// @throws InvalidInput as validate(system), or for W of another shape or not positive
/// semidefinite.
OutputCovariance output_covariance(const plant::StateSpace& system,
                                   const Eigen::MatrixXd& intensity);

}  // namespace boresight::control
