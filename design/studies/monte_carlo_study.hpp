#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <boresight/design/studies/monte_carlo_summary.hpp>

namespace boresight::design {

struct MonteCarloOptions {
  std::uint64_t plants = 10000;
  std::uint64_t seed = 1;
  /// Also tunes a controller for each plant: see MonteCarlo::retune.
  bool retune = false;
  unsigned threads = 1;
  /// Polled between plants, from any thread; true ends the work.
  std::function<bool()> interrupted = {};
};

/// A Monte Carlo study of one controller, gains fixed, on samples of the mission's antenna from the
/// distribution. It covers the design wind and the climate, against the mission's constraints. Use
/// it for a MonteCarloRun that is distributed over processes or written to a file; otherwise use
/// study_monte_carlo.
/// @throws InvalidInput as tracking_problem and constraints; the plant of a sample as
/// plant::changed and plant::linear_plant.
MonteCarlo monte_carlo_of(const Mission& mission, const PlantDistribution& distribution,
                          const control::Controller& controller, const MonteCarloOptions& options);

/// Runs that study, completely or until an interrupt, and summarises its plants. The result does
/// not depend on the number of threads.
/// @throws Interrupted where no block of plants is complete; InvalidInput without plants, as
/// monte_carlo_of and MonteCarloEvaluator; NumericalFailure for a plant that cannot be evaluated.
MonteCarloSummary study_monte_carlo(const Mission& mission, const PlantDistribution& distribution,
                                    const control::Controller& controller,
                                    const MonteCarloOptions& options);

/// Probabilities that a plant of a distribution, gains fixed, ...
struct SampledProbabilities {
  /// ... is stable and within every constraint: MonteCarloSummary::all_constraints_met.
  EstimatedNumber constraints_met;
  /// ... meets each budget, in the wind up to which the budget is needed, or in the mission's
  /// design wind if it states none. At the design wind: MonteCarloSummary::budgets, with the given
  /// effect in place of its simulation.
  std::vector<EstimatedNumber> budgets_met;
};

/// Those of study_monte_carlo with these options, without its simulation. @throws as instability.
SampledProbabilities sampled_probabilities(const Mission& mission,
                                           const PlantDistribution& distribution,
                                           const control::Controller& controller,
                                           const std::vector<PointingBudget>& budgets,
                                           const NonlinearEffect& effect,
                                           const MonteCarloOptions& options);

/// MonteCarloSummary::instability of that study alone, without its simulation.
/// @throws as study_monte_carlo, but not Interrupted: it is not polled.
EstimatedNumber instability(const Mission& mission, const PlantDistribution& distribution,
                            const control::Controller& controller,
                            const MonteCarloOptions& options);

}  // namespace boresight::design
