#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <boresight/design/tracking_problem.hpp>

namespace boresight::design {

/// What a design must meet (hard goals). The soft goal is the least beam rms.
struct HardGoals {
  /// Largest |S| allowed at each break, in the order of control::loop_breaks.
  std::array<double, 3> sensitivity_peak{2.0, 2.0, 2.0};
  double valve_effort = 0.6;  // rad/s rms of noise-driven valve command
};

struct TuningOptions {
  int starts = 20;
  std::uint64_t seed = 1;
  int evaluations_per_start = 150;
  /// Frequency grid of the search; its best laws are then tuned again on the problem's own grid.
  int search_points_per_decade = 100;
  /// Gains to start from besides, straight on the problem's own grid: a neighbour's optimum. With
  /// these, `starts` may be 0.
  std::vector<std::vector<double>> warm_starts;
};

enum class TuningStatus {
  optimal,     // the best feasible law seen
  infeasible,  // no feasible law seen: the stable one nearest to the goals
  unstable,    // no stable law seen
};

/// The best feasible control law seen over all starts.
struct TuningResult {
  TuningStatus status = TuningStatus::infeasible;
  control::ControlLaw law;
  control::LoopEvaluation evaluation;
  /// Largest ratio of a goal's quantity to its limit: at most 1 when feasible.
  double worst_goal_ratio = 0.0;
  /// The goals met with less than 0.1 % to spare: what limits the result.
  std::vector<std::string> active_goals;
  /// Gains that rest on a bound of the search.
  std::vector<std::string> gains_at_bound;
  int starts = 0;
  /// Starts whose own best feasible rms is within 1 % of the best.
  int starts_at_optimum = 0;
  int evaluations = 0;
  /// Searches the optimiser gave up with an error; their records count all the same.
  int optimiser_failures = 0;
};

/// The largest of quantity/limit over the hard goals; infinity for an unstable loop.
double worst_goal_ratio(const control::LoopEvaluation& evaluation, const HardGoals& goals);

/// Least beam rms under the hard goals: NLopt's SLSQP on the logarithms of the gains, within the
/// bounds of gain_descriptions, from seeded log-uniform starts, each pulled back towards a stable
/// law if it is unstable, first on a coarse frequency grid, then from the best three on the
/// problem's own. The highest three local maxima of |S| at each break are separate constraints with
/// analytic gradients. The optimiser's own word is not used: every evaluation is recorded here, and
/// only feasible ones whose eigenvalues are stable can win. Deterministic by seed.
/// A plant that no law of the search stabilises is a stated result, not an error.
/// @throws InvalidInput for options below 1 (starts: below 0, or 0 without warm starts).
TuningResult tune(const TrackingProblem& problem, const control::LoopStructure& structure,
                  const HardGoals& goals, const TuningOptions& options);

}  // namespace boresight::design
