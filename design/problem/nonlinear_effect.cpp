#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <boresight/design/problem/nonlinear_effect.hpp>

namespace boresight::design {

double limit_cycle_rms(double amplitude) {
  return amplitude / std::numbers::sqrt2;
}

NonlinearEffect NonlinearEffect::of_simulation(double simulated, double linear, double amplitude) {
  return {std::isfinite(simulated) ? simulated / linear : std::numeric_limits<double>::infinity(),
          amplitude};
}

double NonlinearEffect::rms(double linear) const {
  return std::hypot(factor * linear, limit_cycle_rms(amplitude));
}

double NonlinearEffect::linear_limit(double budget) const {
  const double cycle = limit_cycle_rms(amplitude);
  if (!std::isfinite(factor) || !(budget > cycle)) return 0.0;
  return std::sqrt((budget - cycle) * (budget + cycle)) / factor;
}

NonlinearEffect NonlinearEffect::for_budgets() const {
  return {std::max(1.0, factor), amplitude};
}

bool within_budget(double rms, double budget) {
  constexpr double round_off = 1e-6;
  return rms <= (1.0 + round_off) * budget;
}

}  // namespace boresight::design
