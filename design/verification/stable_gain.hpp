#pragma once

#include <optional>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Largest factor up to 1 of a state-space controller's output at which its loop on the problem's
/// plant is stable (control::stability), to 1 %: 1 if it is stable as it is. It searches downwards
/// in steps of 5 % to 1e-3. None if no such factor is stable.
/// @throws InvalidInput for a controller with gains.
std::optional<double> largest_stable_factor(const TrackingProblem& problem,
                                            const control::Controller& controller);

}  // namespace boresight::design
