#include <cmath>
#include <limits>

#include <boresight/design/problem/budget_speeds.hpp>
#include <boresight/design/studies/pointing_evaluation.hpp>

namespace boresight::design {
namespace {

void evaluate_stable(const Mission& mission, const PlantEnsemble& ensemble,
                     const TuningStudy& study, TunedController& row) {
  const control::Controller& controller = row.design.tuning.controller;
  TrackingProblem problem = tracking_problem(mission);
  problem.wind.mean_speed = row.wind_speed;
  control::LoopEvaluator evaluator = make_evaluator(problem);
  const auto evaluation = evaluator.evaluate(controller, false);
  row.boresight_rms = std::sqrt(evaluation.boresight_variance()) / problem.gear_ratio;
  row.speed_limits = budget_speeds(problem, evaluator, controller, evaluation.noise_variance,
                                   study.budgets, NonlinearEffect{});
  if (!mission.climate.empty()) {
    problem.climate = mission.climate;
    row.climate_rms =
        std::sqrt(make_evaluator(problem).evaluate(controller, false).boresight_variance()) /
        problem.gear_ratio;
  }
  if (!ensemble.members.empty()) {
    row.ensemble = evaluate(problem_at(mission, study, row.wind_speed), ensemble.members,
                            controller, study.goals, 1);
  }
  row.trade = position_gain_trade(problem, row.design.tuning, row.boresight_rms, study.goals,
                                  ensemble.members);
}

}  // namespace

TrackingProblem problem_at(const Mission& mission, const TuningStudy& study, double wind_speed) {
  TrackingProblem problem = tracking_problem(mission);
  problem.wind.mean_speed = wind_speed;
  if (study.minimises_climate) problem.climate = mission.climate;
  return problem;
}

void evaluate_pointing(const Mission& mission, const PlantEnsemble& ensemble,
                       const TuningStudy& study, TunedController& row) {
  if (row.stable()) {
    evaluate_stable(mission, ensemble, study, row);
  } else {
    row.boresight_rms = std::numeric_limits<double>::quiet_NaN();
    row.speed_limits.assign(study.budgets.size(), row.boresight_rms);
  }
  const bool every_member = !row.ensemble || row.ensemble->within_constraints ==
                                                 static_cast<int>(row.ensemble->members.size());
  row.constraints_met = row.stable() && row.design.tuning.status == TuningStatus::optimal &&
                        (row.tuned_for != TunedFor::robust || every_member);
}

}  // namespace boresight::design
