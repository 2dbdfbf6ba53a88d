#include <algorithm>
#include <map>

#include <boresight/design/ensembles/budgets_on_plants.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::design {

std::vector<std::optional<int>> plants_within_budgets(
    const TrackingProblem& problem, const std::vector<EnsembleMember>& members,
    const control::Controller& controller, const Constraints& goals,
    const std::vector<PointingBudget>& budgets, const NonlinearEffect& effect, unsigned threads) {
  std::map<double, EnsembleResult> by_speed;
  std::vector<std::optional<int>> met;
  for (const auto& budget : budgets) {
    met.emplace_back();
    if (!budget.wind_speed) continue;
    auto found = by_speed.find(*budget.wind_speed);
    if (found == by_speed.end()) {
      TrackingProblem windy = problem;
      windy.wind.mean_speed = *budget.wind_speed;
      found =
          by_speed.emplace(*budget.wind_speed, evaluate(windy, members, controller, goals, threads))
              .first;
    }
    met.back() =
        static_cast<int>(std::ranges::count_if(found->second.members, [&](const auto& member) {
          return member.stable && within_budget(effect.rms(member.boresight_rms), budget.rms);
        }));
  }
  return met;
}

}  // namespace boresight::design
