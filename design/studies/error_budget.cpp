#include <cmath>

#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/studies/error_budget.hpp>
#include <boresight/design/verification/linear_prediction.hpp>

namespace boresight::design {

ErrorBudget error_budget(const TrackingProblem& problem, const Design& design,
                         const TimeDomainStudy* in_time) {
  ErrorBudget budget;
  budget.wind = design.wind_rms;
  budget.noise = design.noise_rms;
  const double linear = std::hypot(budget.wind, budget.noise);
  if (in_time != nullptr) {
    // Of a run that was lost there is no rms.
    const double simulated = in_time->own().simulated_rms();
    if (simulated > linear) {
      budget.nonlinearities = std::sqrt((simulated - linear) * (simulated + linear));
    }
    budget.limit_cycle = limit_cycle_rms(limit_cycle_amplitude(in_time->result.limit_cycles));
  }
  budget.total = std::hypot(linear, budget.nonlinearities, budget.limit_cycle);
  budget.static_error = static_boresight_error(problem, design.tuning.controller);
  return budget;
}

}  // namespace boresight::design
