#pragma once

#include <boresight/plant/integration/feedback_system.hpp>

namespace boresight::plant {

/// A feedback system under a continuous controller, both joined by name: inputs of the controller
/// that are called as an observed output of the system are fed from it, its outputs drive the
/// inputs of the system called so. What is left of the system's inputs u comes first, then what is
/// left of the controller's; observed are the system's outputs, then the controller's. Channels
/// stay as they are, so that a rate loop in analog electronics is integrated with the antenna.
/// @throws InvalidInput for an output of the controller that is no input of the system, a name that
/// both observe, a sampled controller, and as connect; NumericalFailure for an algebraic loop
/// without solution.
FeedbackSystem closed(const FeedbackSystem& system, const StateSpace& controller);

}  // namespace boresight::plant
