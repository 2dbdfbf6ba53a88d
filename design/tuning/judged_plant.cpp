#include <algorithm>
#include <limits>

#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/tuning/judged_plant.hpp>

namespace boresight::design {

double PlantJudgement::worst_ratio() const {
  if (!stable) return std::numeric_limits<double>::infinity();
  return ratios.empty() ? 0.0 : std::ranges::max(ratios, {}, &GoalRatio::ratio).ratio;
}

JudgedPlant::JudgedPlant(std::string name, const TrackingProblem& problem, const HardGoals& goals,
                         const WindTable& wind, double tolerance)
    : name_(std::move(name)),
      plant_(problem.plant),
      delay_(problem.delay),
      goals_(goals),
      frequency_(analysis_grid(problem)),
      evaluator_(make_adaptive_evaluator(problem, wind, tolerance)) {
  if (goals.ask_for_gusts()) {
    const auto& drive = problem.plant.drive;
    mean_.torque =
        plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / problem.gear_ratio;
    mean_.demand = drive.leakage_rate / drive.oil_stiffness * mean_.torque;
    if (problem.climate.empty()) {
      evaluator_.look_at_gusts(true);
    } else {
      TrackingProblem windy = problem;
      windy.climate.clear();
      gusts_.push_back(make_adaptive_evaluator(windy, WindTable(windy)));
      gusts_.back().look_at({false, false, false});
      gusts_.back().look_at_gusts(true);
    }
  }
  if (goals.ask_for_margins()) {
    channels_.push_back(control::make_channels(plant_, frequency_));
  }
}

const PlantJudgement& JudgedPlant::judge(const control::ControlLaw& law, bool with_gradients) {
  judgement_.evaluation = evaluator_.evaluate(law, with_gradients);
  judgement_.stable = judgement_.evaluation.stable();
  judgement_.ratios.clear();
  if (!judgement_.stable) return judgement_;
  auto& evaluation = judgement_.evaluation;
  if (!gusts_.empty()) {
    const auto gusts = gusts_.front().evaluate(law, with_gradients);
    evaluation.wind_demand_variance = gusts.wind_demand_variance;
    evaluation.wind_torque_variance = gusts.wind_torque_variance;
    evaluation.wind_demand_log_gradient = gusts.wind_demand_log_gradient;
    evaluation.wind_torque_log_gradient = gusts.wind_torque_log_gradient;
  }
  append_goal_ratios(evaluation, goals_, mean_, judgement_.ratios);
  if (!channels_.empty()) {
    append_margin_ratios(channels_.front(), delay_, law, goals_, judgement_.ratios);
  }
  return judgement_;
}

bool JudgedPlant::stable_by_eigenvalues(const control::ControlLaw& law) const {
  return control::stability(plant_, law, delay_, frequency_).stable();
}

}  // namespace boresight::design
