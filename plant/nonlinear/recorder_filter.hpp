#pragma once

#include <Eigen/Core>

namespace boresight::plant {

/// The analog low-pass before a recorder's converter: Butterworth, of the given order and corner
/// (Hz, 3 dB), gain 1 at rest.
struct LowPass {
  int order = 0;  // 0: none
  double corner = 0.0;
};

/// How many steps a run takes between two of the recorder's samples so that a signal that is
/// straight between steps stands for it: at least 20 steps a period of the corner and 10 a period
/// of `highest`, the fastest thing in it (Hz, 0: nothing).
/// @throws InvalidInput if those are more than 256.
Eigen::Index steps_per_sample(const LowPass& filter, double sample_time, double highest);

/// What the filter makes of a signal in steps of `interval`, straight between them, at every
/// `stride`-th of them, from rest at the first value. Exact but for the straight lines.
Eigen::VectorXd filtered(const LowPass& filter, const Eigen::VectorXd& signal, double interval,
                         Eigen::Index stride);

}  // namespace boresight::plant
