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

#include <boresight/design/ensembles/held_gains_evaluator.hpp>

namespace boresight::design {

/// How it is known whether a loop is stable.
enum class Standing : std::uint32_t {
  stable_by_winding,      // far from the axis, along the frequencies alone
  stable_by_eigenvalues,  // closed-loop eigenvalues, dead time by its residue
  unstable,               // an eigenvalue in the right half plane
  undecided,  // eigenvalues stable, but not beyond what the rational dead time leaves out
};

/// One law on one plant. Rms at the sky in rad, one axis; NaN where the loop is not shown to be
/// stable, and for what was not asked for. No bytes but these: written to files as it is.
struct PlantOutcome {
  double beam_rms = 0.0;                      // in the problem's wind at its mean speed
  double climate_rms = 0.0;                   // root of the mean square over the problem's climate
  double valve_effort = 0.0;                  // rad/s
  std::array<double, 3> sensitivity_peaks{};  // order of control::loop_breaks
  double worst_goal_ratio = 0.0;              // infinity where not shown to be stable
  /// Of a law tuned for this plant alone, as beam_rms; NaN where no law found meets the goals.
  double retuned_rms = 0.0;
  std::uint32_t broken_goals = 0;  // bits, in the order of goal_names()
  Standing standing = Standing::stable_by_winding;
  /// Eigenvalues were asked; whether the winding had said otherwise.
  std::uint32_t confirmed = 0, contradicted = 0;

  bool stable() const { return standing <= Standing::stable_by_eigenvalues; }
};
static_assert(sizeof(PlantOutcome) == 10 * sizeof(double));

/// The goals that a law may break, in the order of PlantOutcome::broken_goals.
std::vector<std::string> goal_names(const HardGoals& goals);

/// A study of one law, its gains held, on many plants.
struct MonteCarlo {
  /// Wind, climate, noise, dead time, bands; of its plant the valve's corner only.
  TrackingProblem problem;
  control::ControlLaw law;
  HardGoals goals;
  std::uint64_t plants = 0;
  /// Plant number `index`: the same whenever it is asked for, from any thread.
  std::function<plant::AntennaPlant(std::uint64_t index)> plant;
  HeldGainsOptions held = {};
  /// Besides those near the axis, every so manyth plant's stability is confirmed by eigenvalues.
  std::uint64_t confirm_every = 100;
  /// Tunes a law for each plant as well, from the held one (TuningOptions::warm_starts), for the
  /// same goals and, if `retune_over_climate`, the rms over the climate: some ms a plant.
  bool retune = false;
  bool retune_over_climate = false;
};

/// Judges plants in any order, on one thread. Not to be shared between threads; copies are
/// independent. What a plant is given does not depend on those before it.
class MonteCarloJudge {
 public:
  /// @throws as HeldGainsEvaluator, and InvalidInput as validate(goals).
  explicit MonteCarloJudge(const MonteCarlo& study);
  /// @throws what MonteCarlo::plant throws; NumericalFailure, naming the plant, as
  /// HeldGainsEvaluator.
  PlantOutcome judge(std::uint64_t index);
  PlantOutcome judge(const plant::AntennaPlant& plant, bool confirm);

 private:
  void confirm(const plant::AntennaPlant& plant, PlantOutcome& outcome);
  void add_margins(const plant::AntennaPlant& plant);
  void set_goals(const plant::AntennaPlant& plant, const HeldGainsValues& values,
                 PlantOutcome& outcome);
  double retuned_rms(const plant::AntennaPlant& plant) const;

  MonteCarlo study_;
  HeldGainsEvaluator held_;
  double mean_torque_ = 0.0;  // N m at the motor
  std::vector<GoalRatio> ratios_;
};

/// The outcomes of a study, block by block.
class MonteCarloRun {
 public:
  static constexpr std::uint64_t block_size = 100;

  /// @throws InvalidInput without plants, and as MonteCarloJudge.
  explicit MonteCarloRun(const MonteCarlo& study);

  struct Options {
    unsigned threads = 1;
    /// Asked between plants, from any thread; true ends the work.
    std::function<bool()> stop = {};
    /// Called now and then, and at the end, from the calling thread while others work.
    std::function<void()> watch = {};
  };
  /// Works on blocks, each taken by the next free thread. Outcomes do not depend on order, threads
  /// or what was done before. An exception of a plant ends the work and comes out of here;
  /// blocks that are whole are kept.
  void work_on(const std::vector<std::size_t>& blocks, const Options& options);

  std::size_t blocks() const { return blocks_; }
  bool whole(std::size_t block) const { return whole_[block].load(std::memory_order_acquire); }
  std::vector<std::size_t> missing_blocks() const;
  std::uint64_t plants_done() const;
  /// Of a block that is whole; its first plant is block * block_size.
  std::span<const PlantOutcome> outcomes(std::size_t block) const;
  /// Puts a block in that was worked out elsewhere. @throws InvalidInput for another size.
  void put(std::size_t block, std::span<const PlantOutcome> outcomes);
  const PlantOutcome& outcome(std::uint64_t index) const { return outcomes_[index]; }
  const MonteCarlo& study() const { return study_; }

 private:
  std::uint64_t size_of(std::size_t block) const;

  MonteCarlo study_;
  MonteCarloJudge judge_;  // that threads copy
  std::size_t blocks_ = 0;
  std::vector<PlantOutcome> outcomes_;
  std::unique_ptr<std::atomic<bool>[]> whole_;
};

}  // namespace boresight::design
