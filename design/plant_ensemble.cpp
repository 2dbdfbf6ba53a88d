#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/control/closed_loop.hpp>
#include <boresight/design/parallel_loop.hpp>
#include <boresight/design/plant_ensemble.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::design {
namespace {

MemberResult judge_member(TrackingProblem problem, const EnsembleMember& member,
                          const control::ControlLaw& law, const HardGoals& goals) {
  problem.plant = member.plant;
  control::LoopEvaluator evaluator = make_evaluator(problem);
  MemberResult result;
  result.name = member.name;
  result.stable =
      control::stability(problem.plant, law, problem.delay, evaluator.response().frequency)
          .stable();
  if (!result.stable) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    result.beam_rms = result.valve_effort = none;
    result.sensitivity_peaks.fill(none);
    result.worst_goal_ratio = std::numeric_limits<double>::infinity();
    return result;
  }
  const control::LoopEvaluation evaluation = evaluator.evaluate(law, false);
  result.beam_rms = std::sqrt(evaluation.beam_variance()) / problem.gear_ratio;
  result.valve_effort = std::sqrt(evaluation.effort_variance);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    result.sensitivity_peaks[b] = evaluation.highest_peak(control::loop_breaks[b]);
  }
  result.worst_goal_ratio = worst_goal_ratio(evaluation, goals);
  return result;
}

}  // namespace

EnsembleResult judge(const TrackingProblem& problem, const std::vector<EnsembleMember>& members,
                     const control::ControlLaw& law, const HardGoals& goals, unsigned threads) {
  if (members.empty()) throw InvalidInput("judge: expected at least one member, found none");
  control::validate(law);
  EnsembleResult result;
  result.members.resize(members.size());
  for_each_index(members.size(), threads, [&](std::size_t i) {
    result.members[i] = judge_member(problem, members[i], law, goals);
  });

  // A goal met to the last digit by the tuner is met.
  constexpr double rounding = 1e-6;
  std::vector<double> rms;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const MemberResult& member = result.members[i];
    if (member.worst_goal_ratio > result.members[result.worst].worst_goal_ratio) result.worst = i;
    if (member.worst_goal_ratio <= 1.0 + rounding) ++result.within_goals;
    if (member.stable) rms.push_back(member.beam_rms);
  }
  result.stable = static_cast<int>(rms.size());
  result.least_rms = result.median_rms = result.high_rms = result.largest_rms =
      std::numeric_limits<double>::quiet_NaN();
  if (rms.empty()) return result;
  std::ranges::sort(rms);
  const auto quantile = [&](double share) {
    return rms[static_cast<std::size_t>(std::lround(share * static_cast<double>(rms.size() - 1)))];
  };
  result.least_rms = rms.front();
  result.median_rms = quantile(0.5);
  result.high_rms = quantile(0.95);
  result.largest_rms = rms.back();
  return result;
}

}  // namespace boresight::design
