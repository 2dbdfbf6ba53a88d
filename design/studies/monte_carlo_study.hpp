#pragma once

#include <cstdint>
#include <functional>

#include <boresight/design/studies/monte_carlo_summary.hpp>

namespace boresight::design {

struct MonteCarloOptions {
  std::uint64_t plants = 10000;
  std::uint64_t seed = 1;
  /// Tunes a law for each plant as well: see MonteCarlo::retune.
  bool retune = false;
  unsigned threads = 1;
  /// Asked between plants, from any thread; true ends the work.
  std::function<bool()> interrupted = {};
};

/// A controller held on the mission's antenna, changed by draws of the distribution: in the design
/// wind and over the climate, against the mission's constraints. For a MonteCarloRun that is shared
/// out or written to a file; else study_monte_carlo.
/// @throws InvalidInput as tracking_problem and constraints; the plant of a draw as plant::changed
/// and plant::linear_plant.
MonteCarlo monte_carlo_of(const Mission& mission, const PlantDistribution& distribution,
                          const control::ControlLaw& law, const MonteCarloOptions& options);

/// That run, whole or as far as it came, and what its plants amount to. The same for any number of
/// threads.
/// @throws Interrupted where no block of plants is whole; InvalidInput without plants, as
/// monte_carlo_of and MonteCarloJudge; NumericalFailure for a plant that cannot be evaluated.
MonteCarloSummary study_monte_carlo(const Mission& mission, const PlantDistribution& distribution,
                                    const control::ControlLaw& law,
                                    const MonteCarloOptions& options);

}  // namespace boresight::design
