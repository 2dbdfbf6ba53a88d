#include <algorithm>
#include <cmath>

#include <boresight/design/decisions/assessment.hpp>

namespace boresight::design {

Fitness fitness(const Assessment& assessment) {
  if (!assessment.stable || !std::isfinite(assessment.linear_rms)) return Fitness::unstable;
  if (!assessment.verified) return Fitness::unverified;
  if (!assessment.nominal_constraints_met) return Fitness::misses_nominal;
  const auto& rms = assessment.simulated_rms;
  if (rms && !std::isfinite(*rms)) return Fitness::lost_in_wind;
  if (assessment.limit_cycles == LimitCycleVerdict::not_allowed) return Fitness::limit_cycle;
  if (assessment.limit_cycles == LimitCycleVerdict::not_shown) return Fitness::not_shown;
  if (!assessment.member_constraints_met) return Fitness::misses_member;
  if (assessment.budgets_met < assessment.budgets_required) return Fitness::misses_budget;
  return Fitness::fit;
}

NonlinearEffect nonlinear_effect(const Assessment& assessment) {
  const double amplitude = assessment.limit_cycle_amplitude.value_or(0.0);
  const auto& rms = assessment.simulated_rms;
  return rms ? NonlinearEffect::of_simulation(*rms, assessment.linear_rms, amplitude)
             : NonlinearEffect{.amplitude = amplitude};
}

double ranking_figure(const Assessment& assessment) {
  const double wind = assessment.simulated_rms.value_or(assessment.linear_rms);
  if (!std::isfinite(wind)) return assessment.linear_rms;
  return std::hypot(wind, limit_cycle_rms(assessment.limit_cycle_amplitude.value_or(0.0)));
}

void count_budget(double budget, Assessment& assessment) {
  ++assessment.budgets_required;
  if (assessment.limit_cycles == LimitCycleVerdict::not_shown) return;
  const double rms = nonlinear_effect(assessment).for_budgets().rms(assessment.linear_rms);
  if (within_budget(rms, budget)) ++assessment.budgets_met;
}

std::optional<numerics::Interval> figure_change(const Assessment& from, const Assessment& to) {
  if (!from.expected || !to.expected) return std::nullopt;
  return relative_change({*from.expected, from.limit_cycle_amplitude.value_or(0.0)},
                         {*to.expected, to.limit_cycle_amplitude.value_or(0.0)});
}

bool are_tied(const Assessment& one, const Assessment& other, double relative) {
  const auto [minimum, largest] = std::minmax({ranking_figure(one), ranking_figure(other)});
  if (largest <= (1.0 + relative) * minimum) return true;
  const auto change = figure_change(one, other);
  return change && change->lower <= 0.0 && change->upper >= 0.0;
}

}  // namespace boresight::design
