#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/design/ensembles/monte_carlo_statistics.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::design {

/// One plant of a Monte Carlo study that is worth naming.
struct NotablePlant {
  std::uint64_t index = 0;
  PlantDraw draw;
  PlantOutcome outcome;
};

/// What the plants of a Monte Carlo study amount to. Rms in rad at the sky, one axis; distributions
/// are over the plants whose loop is stable, probabilities over all plants that were evaluated.
struct MonteCarloSummary {
  bool interrupted = false;
  std::uint64_t plants_asked = 0, plants = 0;  // evaluated: blocks that are whole
  std::vector<UncertainInput> inputs;
  bool climate = false;
  HardGoals goals;

  std::uint64_t stable = 0, unstable = 0, undecided = 0;
  EstimatedNumber instability;     // probability, undecided ones counted
  std::uint64_t confirmed = 0;     // by eigenvalues
  std::uint64_t contradicted = 0;  // the winding had said otherwise
  double confirm_peak = 0.0;
  std::uint64_t confirm_every = 0;
  std::vector<NotablePlant> unstable_plants;  // the first most_listed
  static constexpr std::size_t most_listed = 1000;

  DistributionSummary beam_rms;
  std::optional<DistributionSummary> climate_rms;
  struct BandLoss {
    PointingBand band;
    DistributionSummary loss;  // dB, mean over two equal axes, at the design's wind speed
    /// The same, expected over the site's wind climate.
    std::optional<DistributionSummary> climate_loss;
  };
  std::vector<BandLoss> losses;
  /// Of a simulation on the mission's own plant; none of it without Antenna::nonlinear or budgets.
  NonlinearEffect effect;
  /// By the linear rms of each plant with that effect (NonlinearEffect::for_budgets).
  struct BudgetChance {
    PointingBudget budget;
    EstimatedNumber met;  // at the design's wind speed; no unstable plant meets one
  };
  std::vector<BudgetChance> budgets;
  struct GoalChance {
    std::string goal;
    EstimatedNumber broken;  // among all plants, by stable ones
  };
  std::vector<GoalChance> goals_broken;
  EstimatedNumber all_goals_met;

  struct Correlation {
    UncertainInput input = UncertainInput::structure_frequency;
    EstimatedNumber with_rms;  // rank correlation, over stable plants
  };
  std::vector<Correlation> correlations;
  std::vector<NotablePlant> worst;  // by beam rms, of the stable ones

  /// Of laws tuned for each plant alone.
  struct Retuned {
    std::uint64_t found = 0;         // plants for which a law that meets the goals was found
    std::uint64_t only_retuned = 0;  // of these, those that the held law does not keep stable
    DistributionSummary beam_rms;
    /// Held law's rms over the re-tuned one's, less 1, of plants that both keep stable.
    DistributionSummary price;
  };
  std::optional<Retuned> retuned;
};

/// What the evaluated plants of a run amount to, against the mission's bands and budgets; the
/// plants are the draws of that distribution and seed. Simulates the controller once, if there are
/// budgets to judge (simulated_effect).
/// @throws Interrupted where no block of plants is whole; as verify_in_time.
MonteCarloSummary summarise(const MonteCarloRun& run, const Mission& mission,
                            const PlantDistribution& distribution, std::uint64_t seed,
                            unsigned threads);

}  // namespace boresight::design
