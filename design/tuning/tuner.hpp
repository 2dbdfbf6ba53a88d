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
  /// Largest number of evaluations of one optimiser run. A start takes a few runs
  /// (FeasibleSearchOptions).
  int evaluations_per_start = 150;
  /// Additional starts, for example a neighbour's optimal gains. With these, `starts` may be 0.
  std::vector<std::vector<double>> warm_starts;
  /// Ensemble members (uncertainty set). The constraints must hold on each of them and on the
  /// problem's own plant. The objective covers the members only; without members every objective is
  /// the nominal one.
  std::vector<EnsembleMember> members = {};
  Objective objective = {};
  /// Number of threads for the starts. The result does not depend on it.
  unsigned threads = 1;
  /// Polled before every evaluation, from any of the threads. True ends the tuning with the best
  /// controller found so far.
  std::function<bool()> stop = {};
};

enum class TuningStatus {
  optimal,     // the best feasible controller found
  infeasible,  // no feasible controller found; the result is the nearest stable one
  unstable,    // no controller found whose eigenvalues are stable
};

/// A constraint active at the optimum, with its shadow price.
struct ActiveConstraint {
  NormalisedConstraint goal;
  std::string member;  // plant name; empty for the problem's own plant
  /// Shadow price from the Lagrange multipliers: relaxing this limit by 1 % lowers the objective's
  /// rms by `shadow_price` per cent. In an infeasible result it lowers the worst ratio instead. The
  /// constraints listed there are mutually incompatible.
  double shadow_price = 0.0;

  /// "sensitivity peak at valve command, 0.84 Hz: relaxing it by 1 % lowers the rms by 0.21 %".
  std::string description() const;
};

/// A gain that rests on a bound of the search, with the shadow price of that bound.
struct LimitingBound {
  std::string gain;
  bool upper = false;
  double shadow_price = 0.0;
};

/// The best feasible controller over all starts.
struct TuningResult {
  TuningStatus status = TuningStatus::infeasible;
  control::Controller controller;
  control::LoopEvaluation evaluation;  // on the problem's own plant
  /// Rms of the objective (rad of motor).
  double soft_rms = 0.0;
  /// Largest normalised constraint (value/limit) over all plants; at most 1 when feasible.
  double worst_constraint = 0.0;
  /// The active constraints: those met with a margin below 0.1 %.
  std::vector<std::string> active_constraints;
  /// The constraints with a positive shadow price, in descending order of it.
  std::vector<ActiveConstraint> limits;
  std::vector<LimitingBound> limiting_bounds;
  /// Norm of the cost's gradient that the multipliers leave unbalanced, relative; near 0 at a true
  /// optimum.
  double gradient_residual = 0.0;
  /// Active members of the last search. The other members met their constraints without being in
  /// it.
  std::vector<std::string> active_scenarios;
  /// Gains that rest on a bound of the search.
  std::vector<std::string> gains_at_bound;
  int starts = 0;
  /// Number of starts whose own best feasible rms is within 1 % of the best.
  int starts_at_optimum = 0;
  int evaluations = 0;
  /// Number of optimiser runs that ended with an error. Their evaluations still count.
  int optimiser_failures = 0;
  /// True if TuningOptions::stop ended the tuning.
  bool interrupted = false;
};

/// The largest value/limit over the constraints on Ms and control effort; infinity for an unstable
/// loop. PlantEvaluator covers all constraints.
double worst_constraint(const control::LoopEvaluation& evaluation, const Constraints& goals);

/// Minimises the boresight rms under the constraints. The method is sequential quadratic
/// programming on the logarithms of the gains (feasible_search.hpp), within the bounds of
/// gain_descriptions. The starts are seeded and log-uniform; an unstable start is first moved
/// towards a stable controller. The best three results are searched again. The highest three local
/// maxima of |S| at each break are separate constraints with analytic gradients. Limits are kept
/// with a reserve of one part in a million.
///
/// With members, the best nominal controller is evaluated on all of them. The worst members become
/// active: those that violate a constraint, are unstable or exceed the objective. This repeats
/// until every member meets its constraints. The starts are then searched again with the active
/// members, and the best three once more in turn. A search from a warm start also uses the members
/// that this start brings near a limit, so that it stays near them. For a quantile the members of
/// the largest rms are left out, as many as the quantile allows. This choice is updated until it no
/// longer changes: a local optimum of the quantile.
///
/// With Constraints::standstill the problem's plant with each friction of it is one more plant that
/// must meet that constraint. It does not count for the objective.
///
/// Only controllers whose eigenvalues are stable on every plant are accepted. If no controller
/// meets every constraint, the result has the smallest worst ratio. `limits` then lists the
/// mutually incompatible constraints. A plant that no controller of the search stabilises is
/// reported by the status, not by an exception. Deterministic by seed.
/// @throws InvalidInput for options below 1 (starts: below 0, or 0 without warm starts), a quantile
/// outside (0, 1], warm starts of another size, and as validate(goals).
TuningResult tune(const TrackingProblem& problem, const control::LoopStructure& structure,
                  const Constraints& goals, const TuningOptions& options);

}  // namespace boresight::design
