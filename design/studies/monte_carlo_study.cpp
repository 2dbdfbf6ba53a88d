#include <cstdint>
#include <memory>
#include <utility>

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

EstimatedNumber instability(const Mission& mission, const PlantDistribution& distribution,
                            const control::Controller& controller,
                            const MonteCarloOptions& options) {
  MonteCarloRun run(monte_carlo_of(mission, distribution, controller, options));
  run.work_on(run.missing_blocks(), {.threads = options.threads, .stop = {}, .watch = {}});
  std::uint64_t unstable = 0;
  for (std::uint64_t index = 0; index < options.plants; ++index) {
    if (!run.outcome(index).stable()) ++unstable;
  }
  return probability(unstable, options.plants);
}

}  // namespace boresight::design
