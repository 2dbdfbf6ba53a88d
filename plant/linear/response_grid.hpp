#pragma once

#include <limits>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

struct ResponseGridOptions {
  /// rad/s; 0: chosen `decades_beyond` below the slowest and above the fastest of the poles (and
  /// other features), an integrator's 0 not counted. A sampled system never goes beyond its Nyquist
  /// frequency pi/T, and reaches it where `highest` is left to choose.
  double lowest = 0.0;
  double highest = 0.0;
  double decades_beyond = 2.0;
  int points_per_decade = 50;
  /// rad/s: no step is longer; for what turns steadily with frequency, as a dead time does.
  double longest_step = std::numeric_limits<double>::infinity();
};

/// Angular frequencies (rad/s) on which the response of a system can be followed: a logarithmic
/// grid between two limits, and around each lightly damped pole p steps of a quarter of its
/// distance from the axis, |Re p|, growing by the factor 1.4 with the distance from Im p until the
/// logarithmic grid is as fine. Rising strictly.
/// @throws InvalidInput as validate(system), for limits that are negative, not finite or not in
/// order, features that are not finite, no points a decade, or a longest step that asks for more
/// than four million points.
Eigen::ArrayXd response_grid(const StateSpace& system, const ResponseGridOptions& options = {});

/// The same around given features: poles, zeros, poles of the closed loop, in s or (with a sample
/// time > 0) in z.
Eigen::ArrayXd response_grid(const Eigen::VectorXcd& features, double sample_time,
                             const ResponseGridOptions& options = {});

/// Poles in z as poles in s = ln(z)/T; z = 0, a delay, as s = -infinity.
Eigen::VectorXcd continuous_equivalent(const Eigen::VectorXcd& poles, double sample_time);

}  // namespace boresight::plant
