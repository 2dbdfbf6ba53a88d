#include <algorithm>
#include <cmath>

#include <boresight/design/tuning/controller_search.hpp>

namespace boresight::design {
namespace {

constexpr std::size_t breaks = control::loop_breaks.size();
constexpr std::size_t most_of_a_kind = control::PeakList::maximum;
// What a constraint counts as that has no quantity at the moment: met by far.
constexpr double absent = -1.0;

// The bounds' own logarithms lead back to them but for a rounding error, which is removed.
void set_gains(control::Controller& controller, const std::vector<double>& point) {
  const auto& descriptions = controller.structure.gains();
  for (std::size_t k = 0; k < point.size(); ++k) {
    controller.gains[k] =
        std::clamp(std::exp(point[k]), descriptions[k].lower, descriptions[k].upper);
  }
  if (!controller.structure.has_conditional_integral()) return;
  std::size_t k = 0;
  for (const auto& block : controller.structure.blocks()) {
    // No linear figure depends on a width.
    if (control::is_integral_condition(block.kind)) {
      controller.gains[k] = std::sqrt(descriptions[k].lower * descriptions[k].upper);
    }
    k += block.gains.size();
  }
}

// The rows of one plant's constraints: a place of its own for each kind of goal at each break and
// each rank, so that the optimiser's multipliers stay with what they were of.
class Rows {
 public:
  explicit Rows(const Constraints& goals) {
    take(GoalKind::sensitivity_peak, breaks * most_of_a_kind);
    take(GoalKind::control_effort, 1);
    if (goals.ask_for_margins()) {
      take(GoalKind::gain_margin, breaks * most_of_a_kind);
      take(GoalKind::phase_margin, breaks * most_of_a_kind);
      take(GoalKind::bandwidth, 1);
    }
    if (goals.gust_demand) take(GoalKind::gust_demand, 1);
    if (goals.gust_torque) take(GoalKind::gust_torque, 1);
    if (goals.static_encoder_error) take(GoalKind::static_encoder_error, 1);
    if (goals.standstill) take(GoalKind::standstill_peak, most_of_a_kind);
  }

  std::size_t count() const { return count_; }

  // Row of each ratio in turn: ratios come by kind and break, in order of rank.
  std::size_t row(const NormalisedConstraint& goal, std::size_t rank) const {
    std::size_t place = first_.at(static_cast<std::size_t>(goal.kind));
    if (goal.kind == GoalKind::standstill_peak) return place + rank;
    if (goal.kind != GoalKind::bandwidth && goal.loop_break) {
      place += static_cast<std::size_t>(*goal.loop_break) * most_of_a_kind + rank;
    }
    return place;
  }

 private:
  void take(GoalKind kind, std::size_t rows) {
    first_.at(static_cast<std::size_t>(kind)) = count_;
    count_ += rows;
  }
  std::array<std::size_t, goal_kinds> first_{};
  std::size_t count_ = 0;
};

struct ControllerProblem {
  std::vector<PlantEvaluator>& plants;
  ActiveScenarios active;
  Rows rows;
  double reserve;
  control::Controller controller;
  std::vector<double> mean_gradient;

  std::vector<std::size_t> used() const {
    std::vector<std::size_t> all = active.goals;
    all.insert(all.end(), active.rms.begin(), active.rms.end());
    std::ranges::sort(all);
    all.erase(std::ranges::unique(all).begin(), all.end());
    return all;
  }

  void fill_goals(const PlantEvaluation& plant_evaluation, std::size_t first,
                  ConstrainedValues& values) {
    const std::size_t size = controller.gains.size();
    std::size_t rank = 0;
    const NormalisedConstraint* before = nullptr;
    for (const NormalisedConstraint& goal : plant_evaluation.ratios) {
      const bool same =
          before != nullptr && before->kind == goal.kind && before->loop_break == goal.loop_break;
      rank = same ? rank + 1 : 0;
      before = &goal;
      const std::size_t row = first + rows.row(goal, rank);
      if (goal.ratio <= 0.0) continue;  // no noise, no effort
      values.constraints[row] = std::log(goal.ratio) + reserve;
      std::copy_n(goal.log_gradient.begin(), size,
                  values.constraint_gradients.begin() + static_cast<std::ptrdiff_t>(row * size));
    }
  }

  bool evaluate(const std::vector<double>& point, const std::vector<std::size_t>& all,
                ConstrainedValues& values) {
    const std::size_t size = point.size();
    set_gains(controller, point);
    std::ranges::fill(values.constraints, absent);
    std::ranges::fill(values.constraint_gradients, 0.0);
    std::ranges::fill(mean_gradient, 0.0);
    double sum = 0.0;
    for (const std::size_t i : all) {
      const PlantEvaluation& plant_evaluation = plants[i].evaluate(controller, true);
      if (!plant_evaluation.stable) return false;
      const auto goal = std::ranges::find(active.goals, i);
      if (goal != active.goals.end()) {
        const auto number = static_cast<std::size_t>(goal - active.goals.begin());
        fill_goals(plant_evaluation, number * rows.count(), values);
      }
      const auto rms = std::ranges::find(active.rms, i);
      if (rms == active.rms.end()) continue;
      const auto& evaluation = plant_evaluation.evaluation;
      const double variance = evaluation.boresight_variance();
      sum += variance;
      const auto number = static_cast<std::size_t>(rms - active.rms.begin());
      if (active.largest) values.objectives[number] = 0.5 * std::log(variance);
      for (std::size_t k = 0; k < size; ++k) {
        const double by = evaluation.wind_log_gradient[k] + evaluation.noise_log_gradient[k];
        mean_gradient[k] += by;
        if (active.largest) values.objective_gradients[number * size + k] = 0.5 * by / variance;
      }
    }
    if (active.largest) return true;
    values.objectives[0] = 0.5 * std::log(sum / static_cast<double>(active.rms.size()));
    for (std::size_t k = 0; k < size; ++k) {
      values.objective_gradients[k] = 0.5 * mean_gradient[k] / sum;
    }
    return true;
  }
};

}  // namespace

std::vector<double> log_gains(const control::Controller& controller) {
  std::vector<double> point(controller.gains.size());
  std::ranges::transform(controller.gains, point.begin(),
                         [](double gain) { return std::log(gain); });
  return point;
}

control::Controller controller_at(const control::LoopStructure& structure,
                                  const std::vector<double>& point) {
  control::Controller controller{structure, point};
  set_gains(controller, point);
  return controller;
}

ConstrainedProblem controller_problem(std::vector<PlantEvaluator>& plants,
                                      const ActiveScenarios& active,
                                      const control::LoopStructure& structure,
                                      const Constraints& goals, double reserve) {
  ConstrainedProblem problem;
  for (const auto& description : control::gain_descriptions(structure)) {
    problem.lower.push_back(std::log(description.lower));
    problem.upper.push_back(std::log(description.upper));
  }
  const std::size_t size = problem.lower.size();
  auto controller =
      std::make_shared<ControllerProblem>(ControllerProblem{plants,
                                                            active,
                                                            Rows(goals),
                                                            reserve,
                                                            {structure, std::vector<double>(size)},
                                                            std::vector<double>(size)});
  problem.objectives = active.largest ? active.rms.size() : 1;
  problem.constraints = active.goals.size() * controller->rows.count();
  problem.evaluate = [controller, all = controller->used()](const std::vector<double>& point,
                                                            ConstrainedValues& values) {
    return controller->evaluate(point, all, values);
  };
  return problem;
}

}  // namespace boresight::design
