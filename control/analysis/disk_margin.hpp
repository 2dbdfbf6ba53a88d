#pragma once

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// Balanced (skew 0) disk margin of a stable loop. Any complex factor f = (1 + d/2)/(1 - d/2) with
/// |d| < alpha in the loop, a simultaneous change of gain and phase, leaves it stable; alpha =
/// 1/sup |S - 1/2| (P. Seiler, A. Packard, P. Gahinet, An Introduction to Disk Margins, IEEE
/// Control Systems 40(5), 2020).
struct DiskMargin {
  double alpha = 0.0;
  double frequency = 0.0;  // rad/s, the critical frequency
  /// Range of gain changes alone within the disk: from (2 - alpha)/(2 + alpha), negative if it
  /// includes a change of sign, to (2 + alpha)/(2 - alpha), infinite for alpha of 2 or more.
  double lowest_gain = 1.0;
  double highest_gain = 1.0;
  double phase_deg = 0.0;  // phase alone, either way: 2 atan(alpha/2)
};

/// The margin with that alpha at that frequency.
DiskMargin disk_margin_of(double alpha, double frequency);

/// Disk margin of a loop L of several channels, each with its own factor: alpha = 1/sup
/// sigma_max((S - T)/2), S = (I + L)^-1, T = I - S, over all frequencies. It also holds for factors
/// that couple the channels. `loop`: L as cut, with as many outputs as inputs (output i closes on
/// input i with the sign -1), continuous or sampled. A loop without margin (I + L singular at some
/// frequency) has alpha 0.
/// @throws InvalidInput as validate(loop), or unless it is square and not empty; NumericalFailure
/// if the closed loop is unstable or has no solution (I + D singular).
DiskMargin disk_margin(const plant::StateSpace& loop);

/// Disk margin for simultaneous factors at the inputs and outputs of the plant: that of the loop [0
/// K; -P 0], controller K in u = -K y. The scaling between inputs and outputs of the plant is
/// chosen to maximise the margin. The result is a lower bound of the margin for the two sets of
/// factors, which do not couple.
/// @throws as disk_margin(loop), and for a plant and a controller with inconsistent shapes or
/// sample times.
DiskMargin disk_margin(const plant::StateSpace& plant, const plant::StateSpace& controller);

}  // namespace boresight::control
