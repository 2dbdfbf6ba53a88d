#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

struct TuningOptions {
  int starts = 30;
  std::uint64_t seed = 1;
  /// Of one run of the optimiser; a start takes a few runs (FeasibleSearchOptions).
  int evaluations_per_start = 150;
  /// Gains to start from besides: a neighbour's optimum. With these, `starts` may be 0.
  std::vector<std::vector<double>> warm_starts;
  /// Plants that may be the true one: every hard goal is held on each of them and on the problem's
  /// own. The soft goal is over these alone; without them every soft goal is the nominal one.
  std::vector<EnsembleMember> members = {};
  SoftGoal soft_goal = {};
  /// Threads the starts are shared out to; the result is the same for any number.
  unsigned threads = 1;
  /// Asked before every evaluation, from any of the threads; true ends the tuning with the best law
  /// found so far.
  std::function<bool()> stop = {};
};

enum class TuningStatus {
  optimal,     // the best feasible law seen
  infeasible,  // no feasible law seen: the stable one nearest to the goals
  unstable,    // no law seen whose eigenvalues are stable
};

/// What holds the result where it is.
struct LimitingGoal {
  GoalRatio goal;
  std::string member;  // the plant; empty for the problem's own
  /// Per cent by which the soft goal's rms falls for each per cent the limit is relaxed, by the
  /// Lagrange multipliers. Of an infeasible result: by which the worst ratio falls. Goals that
  /// stand in an infeasible result contradict one another.
  double price = 0.0;

  /// "sensitivity peak at valve command, 0.84 Hz: relaxing it by 1 % lowers the rms by 0.21 %".
  std::string description() const;
};

/// A gain that rests on a bound of the search, and the same price of the bound.
struct LimitingBound {
  std::string gain;
  bool upper = false;
  double price = 0.0;
};

/// The best feasible control law seen over all starts.
struct TuningResult {
  TuningStatus status = TuningStatus::infeasible;
  control::ControlLaw law;
  control::LoopEvaluation evaluation;  // on the problem's own plant
  /// The soft goal's rms (rad of motor).
  double soft_rms = 0.0;
  /// Largest ratio of a goal's quantity to its limit, over all plants: at most 1 when feasible.
  double worst_goal_ratio = 0.0;
  /// The goals met with less than 0.1 % to spare: what limits the result.
  std::vector<std::string> active_goals;
  /// The goals with a price, dearest first.
  std::vector<LimitingGoal> limits;
  std::vector<LimitingBound> limiting_bounds;
  /// What multipliers leave of the cost's gradient, relative: near 0 at a true optimum.
  double gradient_residual = 0.0;
  /// Members the last search carried; the others held their goals without.
  std::vector<std::string> carried_members;
  /// Gains that rest on a bound of the search.
  std::vector<std::string> gains_at_bound;
  int starts = 0;
  /// Starts whose own best feasible rms is within 1 % of the best.
  int starts_at_optimum = 0;
  int evaluations = 0;
  /// Searches the optimiser gave up with an error; their records count all the same.
  int optimiser_failures = 0;
  /// TuningOptions::stop ended it.
  bool interrupted = false;
};

/// The largest of quantity/limit over the goals of sensitivity peaks and valve effort; infinity for
/// an unstable loop. JudgedPlant looks at all goals.
double worst_goal_ratio(const control::LoopEvaluation& evaluation, const HardGoals& goals);

/// Least beam rms under the hard goals: sequential quadratic programming on the logarithms of the
/// gains (feasible_search.hpp), within the bounds of gain_descriptions, from seeded log-uniform
/// starts, each pulled back towards a stable law if it is unstable, and from the best three once
/// more. The highest three local maxima of |S| at
/// each break are separate constraints with analytic gradients; limits are kept by one part in a
/// million.
///
/// With members: the best nominal law is judged on all of them, those that break a goal the most
/// (or are unstable, or stand above the soft goal) are carried along, and so on until every member
/// holds its goals; then the starts are searched again with the carried members, and the best three
/// once more in turn. Warm starts are searched from with the members carried that they bring near a
/// goal, so that the search stays with them. A quantile leaves the right number of members out of
/// the largest rms, those highest at the moment, until they stay the same: a local optimum of the
/// quantile.
///
/// Only laws whose eigenvalues are stable on every plant can win. Where no law holds every goal,
/// the result is the law whose largest ratio is least, and `limits` says which goals contradict one
/// another; a plant that no law of the search stabilises is a stated result, not an error.
/// Deterministic by seed.
/// @throws InvalidInput for options below 1 (starts: below 0, or 0 without warm starts), a quantile
/// outside (0, 1], warm starts of another size, and as validate(goals).
TuningResult tune(const TrackingProblem& problem, const control::LoopStructure& structure,
                  const HardGoals& goals, const TuningOptions& options);

}  // namespace boresight::design
