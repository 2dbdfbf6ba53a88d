#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/problem/mean_wind_load.hpp>
#include <boresight/design/tuning/plant_evaluator.hpp>

namespace boresight::design {

double PlantEvaluation::worst_ratio() const {
  if (!stable) return std::numeric_limits<double>::infinity();
  return ratios.empty() ? 0.0 : std::ranges::max(ratios, {}, &NormalisedConstraint::ratio).ratio;
}

PlantEvaluator::PlantEvaluator(std::string name, const TrackingProblem& problem,
                               const Constraints& goals, const WindTable& wind, double tolerance)
    : name_(std::move(name)),
      plant_(problem.plant),
      delay_(problem.delay),
      gear_ratio_(problem.gear_ratio),
      goals_(goals),
      mean_(mean_wind_load(problem)),
      frequency_(analysis_grid(problem)),
      evaluator_(make_adaptive_evaluator(problem, wind, tolerance)) {
  if (goals.ask_for_gusts()) {
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

PlantEvaluator PlantEvaluator::at_standstill(TrackingProblem problem, std::size_t place,
                                             const Constraints& goals, const WindTable& wind,
                                             double tolerance) {
  const Standstill& standstill = goals.standstill.value();
  const double friction = standstill.friction.at(place);
  problem.plant.drive.viscous_friction = friction;
  Constraints own;
  own.standstill = standstill;
  PlantEvaluator plant(fmt::format("friction {:.3g} N.m.s/rad", friction), problem, own, wind,
                       tolerance);
  plant.at_standstill_ = true;
  if (!standstill.amplitude.empty()) plant.amplitude_ = standstill.amplitude.at(place);
  std::array<bool, control::loop_breaks.size()> breaks{};
  breaks[static_cast<std::size_t>(control::LoopBreak::valve_command)] = true;
  plant.evaluator_.look_at(breaks);
  return plant;
}

const PlantEvaluation& PlantEvaluator::evaluate(const control::Controller& controller,
                                                bool with_gradients) {
  const bool conditional = amplitude_ > 0.0 && controller.structure.has_conditional_integral();
  if (conditional) control::set_linear_equivalent(controller, amplitude_, equivalent_);
  plant_evaluation_.evaluation =
      evaluator_.evaluate(conditional ? equivalent_ : controller, with_gradients);
  plant_evaluation_.stable = plant_evaluation_.evaluation.stable();
  plant_evaluation_.ratios.clear();
  if (!plant_evaluation_.stable) return plant_evaluation_;
  auto& evaluation = plant_evaluation_.evaluation;
  if (at_standstill_) {
    append_standstill_peaks(evaluation, *goals_.standstill, plant_evaluation_.ratios);
    return plant_evaluation_;
  }
  if (!gusts_.empty()) {
    const auto gusts = gusts_.front().evaluate(controller, with_gradients);
    evaluation.wind_demand_variance = gusts.wind_demand_variance;
    evaluation.wind_torque_variance = gusts.wind_torque_variance;
    evaluation.wind_demand_log_gradient = gusts.wind_demand_log_gradient;
    evaluation.wind_torque_log_gradient = gusts.wind_torque_log_gradient;
  }
  append_normalised_constraints(evaluation, goals_, mean_, plant_evaluation_.ratios);
  if (goals_.static_encoder_error) {
    plant_evaluation_.ratios.push_back(static_error_constraint(
        controller, mean_.demand, gear_ratio_, *goals_.static_encoder_error));
  }
  if (!channels_.empty()) {
    append_margin_ratios(channels_.front(), delay_, controller, goals_, plant_evaluation_.ratios);
  }
  return plant_evaluation_;
}

bool PlantEvaluator::stable_by_eigenvalues(const control::Controller& controller) const {
  const auto is_stable = [&](const control::Controller& linear) {
    return control::stability(plant_, linear, delay_, frequency_).stable();
  };
  if (!controller.structure.has_conditional_integral()) return is_stable(controller);
  const bool standing = amplitude_ > 0.0;
  return is_stable(standing ? control::linear_equivalent(controller, amplitude_) : controller) &&
         is_stable(control::without_conditional_integral(controller));
}

void append_standstill(const TrackingProblem& problem, const Constraints& goals,
                       const WindTable& wind, std::vector<PlantEvaluator>& plants,
                       double tolerance) {
  if (!goals.standstill) return;
  for (std::size_t place = 0; place < goals.standstill->friction.size(); ++place) {
    plants.push_back(PlantEvaluator::at_standstill(problem, place, goals, wind, tolerance));
  }
}

}  // namespace boresight::design
