#include <cmath>
#include <limits>
#include <numbers>

#include <boresight/design/problem/static_bending.hpp>
#include <boresight/design/studies/error_budget.hpp>

namespace boresight::design {
namespace {

// NaN where no run completed.
double simulated_rms_of(const TimeDomainStudy* in_time) {
  if (in_time == nullptr) return std::numeric_limits<double>::quiet_NaN();
  if (in_time->rms && std::isfinite(in_time->rms->rms.value)) return in_time->rms->rms.value;
  return in_time->result.wind.beam_rms;
}

}  // namespace

ErrorBudget error_budget(const TrackingProblem& problem, const Design& design,
                         const TimeDomainStudy* in_time) {
  ErrorBudget budget;
  budget.wind = design.wind_rms;
  budget.noise = design.noise_rms;
  const double linear = std::hypot(budget.wind, budget.noise);
  const double simulated = simulated_rms_of(in_time);
  if (simulated > linear) {
    budget.nonlinearities = std::sqrt((simulated - linear) * (simulated + linear));
  }
  if (in_time != nullptr) {
    budget.limit_cycle = hunting_amplitude(in_time->result.hunting) / std::numbers::sqrt2;
  }
  budget.total = std::hypot(linear, budget.nonlinearities, budget.limit_cycle);
  budget.static_flexure = std::abs(static_bending(problem));
  return budget;
}

}  // namespace boresight::design
