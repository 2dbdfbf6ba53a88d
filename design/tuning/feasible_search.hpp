#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace boresight::design {

/// Values and gradients at a point of the search. The problem's callback fills them in; every
/// vector already has its full size. Gradients are stored row by row: one row per entry, one column
/// per variable.
struct ConstrainedValues {
  std::vector<double> objectives;  // the cost is the largest of them
  std::vector<double> objective_gradients;
  std::vector<double> constraints;  // met where <= 0
  std::vector<double> constraint_gradients;

  double cost() const;
  /// The largest constraint; minus infinity without constraints.
  double violation() const;
};

/// Minimise the largest objective within a box, with every constraint at most 0. The callback
/// returns whether the point is defined (for example a stable loop); values of an undefined point
/// are not read. A NaN or infinity in a value or gradient counts as undefined. Kinks are permitted:
/// give each smooth branch as an entry of its own.
struct ConstrainedProblem {
  std::vector<double> lower, upper;
  std::size_t objectives = 1;
  std::size_t constraints = 0;
  std::function<bool(const std::vector<double>& point, ConstrainedValues& values)> evaluate;
};

struct FeasibleSearchOptions {
  /// Largest number of evaluations of one optimiser run. A start takes at most
  /// 2 (max_restarts + 2) runs.
  int evaluations_per_run = 150;
  /// Largest number of restarts of a run from its end point. A run is restarted only if the last
  /// run lowered the cost by more than `worthwhile_gain`.
  int max_restarts = 4;
  double worthwhile_gain = 1e-3;
  /// A run ends when the variables change by less than `variable_tolerance` (relative) or the cost
  /// by less than `cost_tolerance`.
  double variable_tolerance = 1e-7;
  double cost_tolerance = 1e-9;
  /// Offset added to every constraint that the optimiser receives, because it ends with a rounding
  /// error beyond its limits. Only points that meet the true constraints are accepted.
  double reserve = 1e-8;
  /// Cost of an undefined point above that of the last defined one. It makes line searches back
  /// off.
  double undefined_penalty = 5.0;
  /// Largest number of steps from an undefined start to a defined point.
  int backtrack_steps = 12;
  /// Largest number of evaluations of all starts together.
  long max_evaluations = std::numeric_limits<long>::max();
  /// Polled before every evaluation. True ends the search; results so far are kept.
  std::function<bool()> stop;
};

struct SearchPoint {
  std::vector<double> point;
  double cost = 0.0;
  double violation = 0.0;  // largest constraint
};

/// Sequential quadratic programming (NLopt's SLSQP) from successive starts, with its own record of
/// the best points. Every evaluation is checked here, and only a point that meets every constraint
/// can become the best. The optimiser's return value is not used; its failures are counted and have
/// no effect. An exception of the callback stops the optimiser and is rethrown. The same calls give
/// identical results.
class FeasibleSearch {
 public:
  /// @throws InvalidInput for bounds that differ in number or are not finite with lower < upper,
  /// for no objective or no callback, and for options below 1 (restarts and tolerances: below 0).
  explicit FeasibleSearch(ConstrainedProblem problem, FeasibleSearchOptions options = {});

  /// Values at a point (cached for the last point); null if the point is undefined.
  /// @throws InvalidInput for a point of another size.
  const ConstrainedValues* evaluate(const std::vector<double>& point);

  /// A random point, uniform within the bounds. The sequence depends on the generator only.
  std::vector<double> random_point(std::mt19937_64& generator) const;

  /// The first defined point on the straight line from `from` to `towards`; returns `towards` if
  /// none is defined before it.
  /// @throws InvalidInput for points of different sizes.
  std::vector<double> backtrack(const std::vector<double>& from,
                                const std::vector<double>& towards);

  /// Searches from a start. Returns the best feasible point found from there, if any. If a start
  /// yields no feasible point, the search first minimises the largest constraint and then continues
  /// by cost. An undefined start ends the search at once; call backtrack() first.
  std::optional<SearchPoint> search_from(const std::vector<double>& start);

  /// Minimises the largest constraint from a start, also below 0. Returns the point of least
  /// violation found from there; nothing if no point was defined.
  std::optional<SearchPoint> approach_from(const std::vector<double>& start);

  /// The feasible point of least cost evaluated so far.
  const std::optional<SearchPoint>& best() const { return best_; }
  /// The defined point of least violation evaluated so far.
  const std::optional<SearchPoint>& nearest() const { return nearest_; }
  long evaluations() const { return evaluations_; }
  long undefined_evaluations() const { return undefined_; }
  int optimiser_failures() const { return failures_; }
  /// True if the stop predicate or the limit on all evaluations ended the search.
  bool stopped() const { return stopped_; }

 private:
  enum class Aim { cost, constraints };
  struct Run;
  void run(Aim aim, const std::vector<double>& start, bool until_feasible);
  void begin(const std::vector<double>& start);
  void consider(const std::vector<double>& point);
  bool finite_values() const;

  ConstrainedProblem problem_;
  FeasibleSearchOptions options_;
  std::vector<double> point_;
  bool defined_ = false;
  ConstrainedValues values_;
  std::optional<SearchPoint> best_, nearest_;              // of all
  std::optional<SearchPoint> start_best_, start_nearest_;  // of the present start
  long evaluations_ = 0, undefined_ = 0;
  int failures_ = 0;
  bool stopped_ = false;
};

}  // namespace boresight::design
