#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <boresight/design/ensembles/fixed_gain_evaluator.hpp>

namespace boresight::design {

/// Basis of the stability verdict.
enum class StabilityBasis : std::uint32_t {
  stable_by_encirclements,  // far from the axis, by Nyquist encirclements alone
  stable_by_eigenvalues,    // closed-loop eigenvalues, dead time by its residue
  unstable,                 // an eigenvalue in the right half plane
  undecided,                // eigenvalues stable, margin below the error of the rational dead time
};

/// One controller on one plant. Rms at the sky in rad, per axis. NaN where stability is not shown,
/// and for values not requested. The struct has no padding: it is written to files as it is.
struct PlantOutcome {
  double boresight_rms = 0.0;                 // in the problem's wind at its mean speed
  double climate_rms = 0.0;                   // root of the mean square over the problem's climate
  double control_effort = 0.0;                // rad/s
  std::array<double, 3> sensitivity_peaks{};  // order of control::loop_breaks
  double worst_constraint = 0.0;              // infinity where not shown to be stable
  /// Of a controller tuned for this plant alone, as boresight_rms; NaN where none found meets the
  /// constraints.
  double retuned_rms = 0.0;
  std::uint32_t violated_constraints = 0;  // bits, in the order of goal_names()
  StabilityBasis stability_basis = StabilityBasis::stable_by_encirclements;
  /// Nonzero: eigenvalues were computed; they contradicted the Nyquist encirclements.
  std::uint32_t confirmed = 0, contradicted = 0;

  bool stable() const { return stability_basis <= StabilityBasis::stable_by_eigenvalues; }
};
static_assert(sizeof(PlantOutcome) == 10 * sizeof(double));

/// Names of the constraints, in the order of PlantOutcome::violated_constraints.
std::vector<std::string> goal_names(const Constraints& goals);
/// In their order: false for a constraint on a loop that the controller does not have
/// (control::has_break).
std::vector<bool> goals_applied(const Constraints& goals, const control::Controller& controller);

/// A study of one controller, evaluated with fixed gains, on many plants.
struct MonteCarlo {
  /// Wind, climate, noise, dead time, bands; of its plant only the valve's corner is used.
  TrackingProblem problem;
  control::Controller controller;
  Constraints goals;
  std::uint64_t plants = 0;
  /// Returns plant number `index`: the same at every call, from any thread.
  std::function<plant::AntennaPlant(std::uint64_t index)> plant;
  FixedGainOptions fixed_gain = {};
  /// Besides plants near the axis, one plant in this many is confirmed by eigenvalues.
  std::uint64_t confirm_every = 100;
  /// Also tunes a controller for each plant, starting from the fixed one
  /// (TuningOptions::warm_starts), for the same constraints. `retune_over_climate`: minimises the
  /// rms over the climate. Takes some ms per plant.
  bool retune = false;
  bool retune_over_climate = false;
};

/// Evaluates plants in any order, on one thread. Use one object per thread; copies are independent.
/// The outcome of a plant does not depend on the plants before it.
class MonteCarloEvaluator {
 public:
  /// @throws as FixedGainEvaluator, and InvalidInput as validate(goals).
  explicit MonteCarloEvaluator(const MonteCarlo& study);
  /// @throws what MonteCarlo::plant throws; NumericalFailure, naming the plant, as
  /// FixedGainEvaluator.
  PlantOutcome evaluate(std::uint64_t index);
  PlantOutcome evaluate(const plant::AntennaPlant& plant, bool confirm);

 private:
  void confirm(const plant::AntennaPlant& plant, PlantOutcome& outcome);
  void add_margins(const plant::AntennaPlant& plant);
  void set_goals(const plant::AntennaPlant& plant, const FixedGainValues& values,
                 PlantOutcome& outcome);
  double retuned_rms(const plant::AntennaPlant& plant) const;

  MonteCarlo study_;
  FixedGainEvaluator fixed_gain_;
  double mean_torque_ = 0.0;  // N m at the motor
  std::vector<NormalisedConstraint> ratios_;
};

/// The outcomes of a study, block by block.
class MonteCarloRun {
 public:
  static constexpr std::uint64_t block_size = 100;

  /// @throws InvalidInput without plants, and as MonteCarloEvaluator.
  explicit MonteCarloRun(const MonteCarlo& study);

  struct Options {
    unsigned threads = 1;
    /// Polled between plants, from any thread; true ends the work.
    std::function<bool()> stop = {};
    /// Called now and then, and at the end, from the calling thread while others work.
    std::function<void()> watch = {};
  };
  /// Evaluates blocks, each taken by the next free thread. Outcomes do not depend on order, threads
  /// or earlier work. An exception of a plant ends the work and is rethrown here; complete blocks
  /// are kept.
  void work_on(const std::vector<std::size_t>& blocks, const Options& options);

  std::size_t blocks() const { return blocks_; }
  bool whole(std::size_t block) const { return whole_[block].load(std::memory_order_acquire); }
  std::vector<std::size_t> missing_blocks() const;
  std::uint64_t plants_done() const;
  /// Outcomes of a complete block; its first plant is block * block_size.
  std::span<const PlantOutcome> outcomes(std::size_t block) const;
  /// Inserts a block computed elsewhere. @throws InvalidInput for another size.
  void put(std::size_t block, std::span<const PlantOutcome> outcomes);
  const PlantOutcome& outcome(std::uint64_t index) const { return outcomes_[index]; }
  const MonteCarlo& study() const { return study_; }

 private:
  std::uint64_t size_of(std::size_t block) const;

  MonteCarlo study_;
  MonteCarloEvaluator evaluator_;  // copied by threads
  std::size_t blocks_ = 0;
  std::vector<PlantOutcome> outcomes_;
  std::unique_ptr<std::atomic<bool>[]> whole_;
};

}  // namespace boresight::design
