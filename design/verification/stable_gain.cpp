#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/verification/stable_gain.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {

std::optional<double> largest_stable_factor(const TrackingProblem& problem,
                                            const control::Controller& controller) {
  const plant::StateSpace* system = controller.structure.state_space();
  if (system == nullptr) {
    throw InvalidInput(
        "largest_stable_factor: expected a state space, found a controller of gains");
  }
  const auto stable = [&](double factor) {
    plant::StateSpace scaled = *system;
    scaled.c *= factor;
    scaled.d *= factor;
    const auto verdict = control::stability(
        problem.plant, control::state_space_controller("scaled", scaled), problem.delay, {});
    return verdict.stable();
  };
  constexpr double step = 0.95, least = 1e-3, resolution = 1.01;
  double factor = 1.0;
  while (!stable(factor)) {
    factor *= step;
    if (factor < least) return std::nullopt;
  }
  if (factor == 1.0) return factor;
  // Between the last two steps.
  for (double above = factor / step; above / factor > resolution;) {
    const double middle = 0.5 * (factor + above);
    (stable(middle) ? factor : above) = middle;
  }
  return factor;
}

}  // namespace boresight::design
