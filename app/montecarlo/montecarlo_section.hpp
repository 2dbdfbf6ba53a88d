#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/design/ensembles/monte_carlo_statistics.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// One plant of a Monte Carlo study that is worth naming.
struct NotablePlant {
  std::uint64_t index = 0;
  design::PlantDraw draw;
  design::PlantOutcome outcome;
};

/// What `boresight montecarlo` found. Rms in rad at the sky, one axis; distributions are over the
/// plants whose loop is stable, probabilities over all plants that were judged.
struct MonteCarloSection {
  std::string case_path, title, axis;
  std::uint64_t seed = 1;
  bool interrupted = false;
  std::uint64_t plants_asked = 0, plants = 0;  // judged: blocks that are whole

  std::string distribution;  // what the plants are drawn from
  std::vector<design::UncertainInput> inputs;
  control::ControlLaw law;
  std::string structure;           // as the user names it
  std::string law_source;          // where the gains come from
  std::vector<std::string> gains;  // in the engineer's units
  plant::WindModel wind_model = plant::WindModel::coherence;
  double wind_speed = 0.0;  // m/s
  bool climate = false;
  design::HardGoals goals;

  std::uint64_t stable = 0, unstable = 0, undecided = 0;
  design::EstimatedNumber instability;  // probability, undecided ones counted
  std::uint64_t confirmed = 0;          // by eigenvalues
  std::uint64_t contradicted = 0;       // the winding had said otherwise
  double confirm_peak = 0.0;
  std::uint64_t confirm_every = 0;
  std::vector<NotablePlant> unstable_plants;  // the first most_listed
  static constexpr std::size_t most_listed = 1000;

  design::DistributionSummary beam_rms;
  std::optional<design::DistributionSummary> climate_rms;
  struct BandLoss {
    design::PointingBand band;
    design::DistributionSummary loss;  // dB, mean over two equal axes, at the design's wind speed
    /// The same, expected over the site's wind climate.
    std::optional<design::DistributionSummary> climate_loss;
  };
  std::vector<BandLoss> losses;
  struct BudgetChance {
    design::PointingBudget budget;
    design::EstimatedNumber met;  // at the design's wind speed; no unstable plant meets one
  };
  std::vector<BudgetChance> budgets;
  struct GoalChance {
    std::string goal;
    design::EstimatedNumber broken;  // among all plants, by stable ones
  };
  std::vector<GoalChance> goals_broken;
  design::EstimatedNumber all_goals_met;

  struct Correlation {
    design::UncertainInput input = design::UncertainInput::structure_frequency;
    design::EstimatedNumber with_rms;  // rank correlation, over stable plants
  };
  std::vector<Correlation> correlations;
  std::vector<NotablePlant> worst;  // by beam rms, of the stable ones

  /// Of laws tuned for each plant alone.
  struct Retuned {
    std::uint64_t found = 0;         // plants for which a law that meets the goals was found
    std::uint64_t only_retuned = 0;  // of these, those that the held law does not keep stable
    design::DistributionSummary beam_rms;
    /// Held law's rms over the re-tuned one's, less 1, of plants that both keep stable.
    design::DistributionSummary price;
  };
  std::optional<Retuned> retuned;

  std::vector<io::Quantity> assumed;
  std::vector<std::string> conclusions;
  std::vector<Figure> figures;
};

}  // namespace boresight::app
