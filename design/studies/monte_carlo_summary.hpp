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

/// One plant of a Monte Carlo study that is listed individually.
struct NotablePlant {
  std::uint64_t index = 0;
  PlantSample draw;
  PlantOutcome outcome;
};

/// Summary of the plants of a Monte Carlo study. Rms in rad at the sky, per axis. Distributions are
/// over the plants whose loop is stable, probabilities over all plants evaluated.
struct MonteCarloSummary {
  bool interrupted = false;
  std::uint64_t plants_asked = 0, plants = 0;  // evaluated: complete blocks
  std::vector<UncertainInput> inputs;
  bool climate = false;
  Constraints goals;

  std::uint64_t stable = 0, unstable = 0, undecided = 0;
  EstimatedNumber instability;     // probability, undecided plants counted as unstable
  std::uint64_t confirmed = 0;     // by eigenvalues
  std::uint64_t contradicted = 0;  // Nyquist encirclements gave the opposite verdict
  double confirm_peak = 0.0;
  std::uint64_t confirm_every = 0;
  std::vector<NotablePlant> unstable_plants;  // the first max_listed
  static constexpr std::size_t max_listed = 1000;

  DistributionSummary boresight_rms;
  std::optional<DistributionSummary> climate_rms;
  struct BandLoss {
    PointingBand band;
    DistributionSummary loss;  // dB, mean for two equal axes, at the design's wind speed
    /// The same, expected over the site's wind climate.
    std::optional<DistributionSummary> climate_loss;
  };
  std::vector<BandLoss> losses;
  /// Of a simulation on the mission's own plant; empty without Antenna::nonlinear or budgets.
  NonlinearEffect effect;
  /// From the linear rms of each plant with that effect (NonlinearEffect::for_budgets).
  struct BudgetProbability {
    PointingBudget budget;
    EstimatedNumber met;  // at the design's wind speed; unstable plants meet no budget
  };
  std::vector<BudgetProbability> budgets;
  struct ConstraintProbability {
    std::string goal;
    EstimatedNumber broken;  // fraction of all plants, violated by stable ones
  };
  std::vector<ConstraintProbability> constraints_violated;
  EstimatedNumber all_constraints_met;

  struct Correlation {
    UncertainInput input = UncertainInput::structure_frequency;
    EstimatedNumber with_rms;  // rank correlation, over stable plants
  };
  std::vector<Correlation> correlations;
  std::vector<NotablePlant> worst;  // stable plants of largest boresight rms

  /// Of controllers tuned for each plant alone.
  struct Retuned {
    std::uint64_t found = 0;  // plants for which a controller that meets the constraints was found
    std::uint64_t only_retuned = 0;  // of these, those that the fixed controller does not stabilise
    DistributionSummary boresight_rms;
    /// Rms of the fixed controller over that of the re-tuned one, less 1, on plants that both
    /// stabilise.
    DistributionSummary fixed_gain_cost;
  };
  std::optional<Retuned> retuned;
};

/// Summarises the evaluated plants of a run against the mission's bands and budgets. The plants are
/// the samples of that distribution and seed. It simulates the controller once if there are budgets
/// to evaluate (simulated_effect).
/// @throws Interrupted where no block of plants is complete; as verify_in_time.
MonteCarloSummary summarise(const MonteCarloRun& run, const Mission& mission,
                            const PlantDistribution& distribution, std::uint64_t seed,
                            unsigned threads);

}  // namespace boresight::design
