#pragma once

#include <string>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A norm, or the reason why it is infinite.
struct H2Norm {
  double value = 0.0;  // infinity if there is a reason
  std::string reason;  // empty where the norm is finite
  /// -max Re(eigenvalue of A), 1/s; for a sampled system 1 - max |eigenvalue|; infinity without
  /// states.
  double stability_margin = 0.0;
};

/// The H2 norm: the root of the summed variances of the outputs for independent white noise of unit
/// intensity (sampled: unit variance) at each input,
///   sqrt(1/(2 pi) integral over w of |H(j w)|^2), Frobenius norm; sampled: over the unit circle.
/// It is computed from a factor of the covariance (lyapunov_factor.hpp), which keeps the digits of
/// outputs with a small part in it. The error is about 1e-16 times the condition of the Lyapunov
/// equation. O(n^3). The norm is infinite, with the reason, for a continuous system with direct
/// feedthrough and for any unstable system, observable at the outputs or not: remove unused states
/// first.
/// @throws InvalidInput as validate(system).
H2Norm h2_norm(const plant::StateSpace& system);

/// The same integral along the axis (circle) for a system with poles on either side of it: the L2
/// norm, the root of the summed squared norms of the stable and the antistable part. Equal to the
/// H2 norm if the system is stable. Infinite for direct feedthrough (continuous) and poles on the
/// axis (circle), to rounding.
/// @throws InvalidInput as validate(system).
H2Norm l2_norm(const plant::StateSpace& system);

/// Covariance of the outputs, or the reason why some of its elements are infinite.
struct OutputCovariance {
  Eigen::MatrixXd covariance;  // outputs x outputs, symmetric
  std::string reason;          // empty where every element is finite
};

/// Covariance of the outputs for white noise of intensity W (inputs x inputs, symmetric positive
/// semidefinite, unit^2 s; sampled: covariance per sample, unit^2): C P C', sampled C P C' + D W
/// D'. For a continuous system the elements where D W D' is not 0 are infinite. For an unstable
/// system every element is infinite.
/// @throws InvalidInput as validate(system), or for W of another shape or not positive
/// semidefinite.
OutputCovariance output_covariance(const plant::StateSpace& system,
                                   const Eigen::MatrixXd& intensity);

}  // namespace boresight::control
