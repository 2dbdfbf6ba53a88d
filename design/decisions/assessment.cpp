#include <cmath>
#include <numbers>

#include <boresight/design/decisions/assessment.hpp>

namespace boresight::design {

Fitness fitness(const Assessment& assessment) {
  if (!assessment.stable || !std::isfinite(assessment.linear_rms)) return Fitness::unstable;
  if (!assessment.verified) return Fitness::unverified;
  if (!assessment.nominal_constraints_met) return Fitness::misses_nominal;
  const auto& rms = assessment.simulated_rms;
  if (rms && !std::isfinite(*rms)) return Fitness::lost_in_wind;
  if (assessment.limit_cycles == LimitCycleVerdict::beyond_budget) return Fitness::limit_cycle;
  if (assessment.limit_cycles == LimitCycleVerdict::not_shown) return Fitness::not_shown;
  if (!assessment.member_constraints_met) return Fitness::misses_member;
  if (assessment.budgets_met < assessment.budgets_required) return Fitness::misses_budget;
  return Fitness::fit;
}

double ranking_figure(const Assessment& assessment) {
  const auto& rms = assessment.simulated_rms;
  if (!rms || !std::isfinite(*rms)) return assessment.linear_rms;
  return std::hypot(*rms, assessment.limit_cycle_amplitude.value_or(0.0) / std::numbers::sqrt2);
}

}  // namespace boresight::design
