#pragma once

#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// At the motor, in the problem's mean wind: the torque, and the leakage flow that holds it, as
/// rate of the motors (leakage rate over oil stiffness, times the torque).
MeanWindLoad mean_wind_load(const TrackingProblem& problem);

}  // namespace boresight::design
