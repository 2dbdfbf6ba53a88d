#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/design/problem/budget_speeds.hpp>

namespace boresight::design {

std::vector<double> budget_speeds(const TrackingProblem& problem,
                                  const control::LoopEvaluator& evaluator,
                                  const control::Controller& controller, double noise_variance,
                                  const std::vector<PointingBudget>& budgets,
                                  const NonlinearEffect& effect) {
  const NonlinearEffect held = effect.for_budgets();
  std::vector<double> speeds;
  speeds.reserve(budgets.size());
  for (const auto& budget : budgets) {
    speeds.push_back(wind_speed_limit(problem, evaluator, controller, noise_variance,
                                      held.linear_limit(budget.rms)));
  }
  return speeds;
}

std::vector<double> budget_speeds(const TrackingProblem& problem,
                                  const control::Controller& controller,
                                  const std::vector<PointingBudget>& budgets,
                                  const NonlinearEffect& effect) {
  auto evaluator = make_evaluator(problem);
  const double noise = evaluator.evaluate(controller, false).noise_variance;
  return budget_speeds(problem, evaluator, controller, noise, budgets, effect);
}

}  // namespace boresight::design
