#include <vector>

#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/tuned_assessment.hpp>

namespace boresight::app {
namespace {

// Relative round-off of a budget that is met to the last digit.
constexpr double round_off = 1e-6;

void count_budget(const TunedLaw& row, double rms, bool with_simulation,
                  design::Assessment& assessment) {
  const double limit = (1.0 + round_off) * rms;
  ++assessment.budgets_required;
  if (with_simulation ? row.keeps(limit) : row.beam_rms <= limit) ++assessment.budgets_met;
}

}  // namespace

design::Assessment assessment_of(const TuneSection& section, const TunedLaw& row,
                                 bool with_simulation) {
  const bool robust = row.tuned_for == TunedFor::robust;
  design::Assessment result;
  result.structure = row.structure;
  result.purpose = robust ? design::DesignPurpose::robust : design::DesignPurpose::nominal;
  result.parts = row.design.tuning.law.structure.gains().size();
  result.stable = row.stable();
  result.verified = row.design.verification.passed;
  result.nominal_constraints_met = row.goals_met;
  result.member_constraints_met = robust && row.goals_met;
  result.linear_rms = row.beam_rms;
  if (with_simulation && row.in_time) {
    const LawInTime& run = *row.in_time;
    result.simulated_rms = run.beam_rms;
    result.limit_cycle_amplitude = run.hunting;
    result.limit_cycles = limit_cycle_verdict(run.still, run.hunting_seen);
  }
  for (const auto& budget : section.budgets) {
    if (budget.wind_speed == row.wind_speed) {
      count_budget(row, budget.rms, with_simulation, result);
    }
  }
  if (section.beam_rms_goal && row.wind_speed == section.wind_speeds.front()) {
    count_budget(row, *section.beam_rms_goal, with_simulation, result);
  }
  return result;
}

const TunedLaw* recommended_at(const TuneSection& section, double wind_speed, bool with_simulation,
                               const design::RecommendOptions& options) {
  std::vector<const TunedLaw*> rows;
  std::vector<design::Assessment> candidates;
  for (const auto& row : section.laws) {
    if (row.tuned_for == TunedFor::present || row.wind_speed != wind_speed) continue;
    rows.push_back(&row);
    candidates.push_back(assessment_of(section, row, with_simulation));
  }
  const auto winner = design::recommend(candidates, options).winner;
  return winner ? rows[*winner] : nullptr;
}

}  // namespace boresight::app
