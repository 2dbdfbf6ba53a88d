#pragma once

#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// What the mean wind bends the structure between encoder and beam (rad at the sky), the mean
/// torque over the springs of the modes: no part of any rms, and seen by no encoder.
double static_bending(const TrackingProblem& problem);

}  // namespace boresight::design
