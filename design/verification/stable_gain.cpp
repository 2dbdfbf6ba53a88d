#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/verification/stable_gain.hpp>

namespace boresight::design {

std::optional<double> largest_stable_factor(const TrackingProblem& problem,
                                            const control::Controller& controller) {
  const auto stable = [&](double factor) {
    return control::stability(problem.plant, control::with_output_times(factor, controller),
                              problem.delay, {})
        .stable();
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
