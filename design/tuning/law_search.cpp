#include <algorithm>
#include <cmath>

#include <boresight/design/tuning/law_search.hpp>

namespace boresight::design {
namespace {

constexpr std::size_t breaks = control::loop_breaks.size();
constexpr std::size_t most_of_a_kind = control::PeakList::most;
// What a constraint counts as that has no quantity at the moment: met by far.
constexpr double absent = -1.0;

// The bounds' own logarithms lead back to them but for a rounding error: that is taken away.
void set_gains(control::ControlLaw& law, const std::vector<double>& point) {
  const auto& descriptions = law.structure.gains();
  for (std::size_t k = 0; k < point.size(); ++k) {
    law.gains[k] = std::clamp(std::exp(point[k]), descriptions[k].lower, descriptions[k].upper);
  }
}

// The rows of one plant's constraints: a place of its own for each kind of goal at each break and
// each rank, so that the optimiser's multipliers stay with what they were of.
class Rows {
 public:
  explicit Rows(const HardGoals& goals) {
    take(GoalKind::sensitivity_peak, breaks * most_of_a_kind);
    take(GoalKind::valve_effort, 1);
    if (goals.ask_for_margins()) {
      take(GoalKind::gain_margin, breaks * most_of_a_kind);
      take(GoalKind::phase_margin, breaks * most_of_a_kind);
      take(GoalKind::bandwidth, 1);
    }
    if (goals.gust_demand) take(GoalKind::gust_demand, 1);
    if (goals.gust_torque) take(GoalKind::gust_torque, 1);
  }

  std::size_t count() const { return count_; }

  // Row of each ratio in turn: ratios come by kind and break, in order of rank.
  std::size_t row(const GoalRatio& goal, std::size_t rank) const {
    std::size_t place = first_.at(static_cast<std::size_t>(goal.kind));
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
  std::array<std::size_t, 7> first_{};
  std::size_t count_ = 0;
};

struct LawProblem {
  std::vector<JudgedPlant>& plants;
  CarriedPlants carried;
  Rows rows;
  double reserve;
  control::ControlLaw law;
  std::vector<double> mean_gradient;

  std::vector<std::size_t> used() const {
    std::vector<std::size_t> all = carried.goals;
    all.insert(all.end(), carried.rms.begin(), carried.rms.end());
    std::ranges::sort(all);
    all.erase(std::ranges::unique(all).begin(), all.end());
    return all;
  }

  void fill_goals(const PlantJudgement& judgement, std::size_t first, ConstrainedValues& values) {
    const std::size_t size = law.gains.size();
    std::size_t rank = 0;
    const GoalRatio* before = nullptr;
    for (const GoalRatio& goal : judgement.ratios) {
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
    set_gains(law, point);
    std::ranges::fill(values.constraints, absent);
    std::ranges::fill(values.constraint_gradients, 0.0);
    std::ranges::fill(mean_gradient, 0.0);
    double sum = 0.0;
    for (const std::size_t i : all) {
      const PlantJudgement& judgement = plants[i].judge(law, true);
      if (!judgement.stable) return false;
      const auto goal = std::ranges::find(carried.goals, i);
      if (goal != carried.goals.end()) {
        const auto number = static_cast<std::size_t>(goal - carried.goals.begin());
        fill_goals(judgement, number * rows.count(), values);
      }
      const auto rms = std::ranges::find(carried.rms, i);
      if (rms == carried.rms.end()) continue;
      const auto& evaluation = judgement.evaluation;
      const double variance = evaluation.beam_variance();
      sum += variance;
      const auto number = static_cast<std::size_t>(rms - carried.rms.begin());
      if (carried.largest) values.objectives[number] = 0.5 * std::log(variance);
      for (std::size_t k = 0; k < size; ++k) {
        const double by = evaluation.wind_log_gradient[k] + evaluation.noise_log_gradient[k];
        mean_gradient[k] += by;
        if (carried.largest) values.objective_gradients[number * size + k] = 0.5 * by / variance;
      }
    }
    if (carried.largest) return true;
    values.objectives[0] = 0.5 * std::log(sum / static_cast<double>(carried.rms.size()));
    for (std::size_t k = 0; k < size; ++k) {
      values.objective_gradients[k] = 0.5 * mean_gradient[k] / sum;
    }
    return true;
  }
};

}  // namespace

std::vector<double> log_gains(const control::ControlLaw& law) {
  std::vector<double> point(law.gains.size());
  std::ranges::transform(law.gains, point.begin(), [](double gain) { return std::log(gain); });
  return point;
}

control::ControlLaw law_at(const control::LoopStructure& structure,
                           const std::vector<double>& point) {
  control::ControlLaw law{structure, point};
  set_gains(law, point);
  return law;
}

ConstrainedProblem law_problem(std::vector<JudgedPlant>& plants, const CarriedPlants& carried,
                               const control::LoopStructure& structure, const HardGoals& goals,
                               double reserve) {
  ConstrainedProblem problem;
  for (const auto& description : control::gain_descriptions(structure)) {
    problem.lower.push_back(std::log(description.lower));
    problem.upper.push_back(std::log(description.upper));
  }
  const std::size_t size = problem.lower.size();
  auto law = std::make_shared<LawProblem>(LawProblem{plants,
                                                     carried,
                                                     Rows(goals),
                                                     reserve,
                                                     {structure, std::vector<double>(size)},
                                                     std::vector<double>(size)});
  problem.objectives = carried.largest ? carried.rms.size() : 1;
  problem.constraints = carried.goals.size() * law->rows.count();
  problem.evaluate = [law, all = law->used()](const std::vector<double>& point,
                                              ConstrainedValues& values) {
    return law->evaluate(point, all, values);
  };
  return problem;
}

}  // namespace boresight::design
