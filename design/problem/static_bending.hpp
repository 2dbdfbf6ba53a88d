#pragma once

#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Static flexure between encoder and boresight under the mean wind (rad at the sky): the mean
/// torque over the stiffness of the modes. It is not included in any rms, and the encoder does not
/// sense it (non-collocated).
double static_bending(const TrackingProblem& problem);

}  // namespace boresight::design
