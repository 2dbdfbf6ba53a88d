#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/studies/monte_carlo_study.hpp>

namespace boresight::design {

MonteCarlo monte_carlo_of(const Mission& mission, const PlantDistribution& distribution,
                          const control::Controller& controller, const MonteCarloOptions& options) {
  MonteCarlo study;
  study.problem = tracking_problem(mission);
  study.problem.climate = mission.climate;
  study.controller = controller;
  study.goals = constraints(mission);
  study.plants = options.plants;
  study.retune = options.retune;
  study.retune_over_climate = mission.minimises_climate;
  // Shared by the copies of the study that threads work with.
  struct Population {
    plant::Antenna antenna;
    PlantDistribution distribution;
  };
  study.plant = [population =
                     std::make_shared<const Population>(Population{mission.antenna, distribution}),
                 seed = options.seed](std::uint64_t index) {
    return linear_plant(
        changed(population->antenna, changes_of(population->distribution.draw(seed, index))));
  };
  return study;
}

MonteCarloSummary study_monte_carlo(const Mission& mission, const PlantDistribution& distribution,
                                    const control::Controller& controller,
                                    const MonteCarloOptions& options) {
  MonteCarloRun run(monte_carlo_of(mission, distribution, controller, options));
  run.work_on(run.missing_blocks(),
              {.threads = options.threads, .stop = options.interrupted, .watch = {}});
  return summarise(run, mission, distribution, options.seed, options.threads);
}

namespace {

// Of every plant: not polled.
std::vector<PlantOutcome> outcomes_of(const Mission& mission, const PlantDistribution& distribution,
                                      const control::Controller& controller,
                                      const MonteCarloOptions& options) {
  MonteCarloRun run(monte_carlo_of(mission, distribution, controller, options));
  run.work_on(run.missing_blocks(), {.threads = options.threads, .stop = {}, .watch = {}});
  std::vector<PlantOutcome> outcomes;
  outcomes.reserve(options.plants);
  for (std::uint64_t index = 0; index < options.plants; ++index) {
    outcomes.push_back(run.outcome(index));
  }
  return outcomes;
}

template <typename Condition>
EstimatedNumber probability_of(const std::vector<PlantOutcome>& outcomes, const Condition& holds) {
  return probability(static_cast<std::uint64_t>(std::ranges::count_if(outcomes, holds)),
                     outcomes.size());
}

}  // namespace

SampledProbabilities sampled_probabilities(const Mission& mission,
                                           const PlantDistribution& distribution,
                                           const control::Controller& controller,
                                           const std::vector<PointingBudget>& budgets,
                                           const NonlinearEffect& effect,
                                           const MonteCarloOptions& options) {
  std::map<double, std::vector<PlantOutcome>> by_speed;
  const auto outcomes_at = [&](double speed) -> const std::vector<PlantOutcome>& {
    auto found = by_speed.find(speed);
    if (found == by_speed.end()) {
      Mission windy = mission;
      windy.wind.mean_speed = speed;
      windy.climate.clear();  // costs time and enters neither budgets nor constraints
      found = by_speed.emplace(speed, outcomes_of(windy, distribution, controller, options)).first;
    }
    return found->second;
  };
  SampledProbabilities result;
  result.constraints_met = probability_of(
      outcomes_at(mission.wind.mean_speed),
      [](const PlantOutcome& one) { return one.stable() && one.violated_constraints == 0; });
  for (const auto& budget : budgets) {
    const auto& outcomes = outcomes_at(budget.wind_speed.value_or(mission.wind.mean_speed));
    result.budgets_met.push_back(probability_of(outcomes, [&](const PlantOutcome& one) {
      return one.stable() && within_budget(effect.rms(one.boresight_rms), budget.rms);
    }));
  }
  return result;
}

EstimatedNumber instability(const Mission& mission, const PlantDistribution& distribution,
                            const control::Controller& controller,
                            const MonteCarloOptions& options) {
  return probability_of(outcomes_of(mission, distribution, controller, options),
                        [](const PlantOutcome& one) { return !one.stable(); });
}

}  // namespace boresight::design
