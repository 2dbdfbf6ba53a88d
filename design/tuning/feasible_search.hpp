#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace boresight::design {

/// What a point of the search gives: filled in by the problem's callback, which finds every vector
/// at its full size. Gradients row by row, one row an entry, one column a variable.
struct ConstrainedValues {
  std::vector<double> objectives;  // the cost is the largest of them
  std::vector<double> objective_gradients;
  std::vector<double> constraints;  // met where <= 0
  std::vector<double> constraint_gradients;

  double cost() const;
  /// The largest constraint; minus infinity without constraints.
  double violation() const;
};

/// Minimise the largest objective within a box, every constraint at most 0. The callback returns
/// whether the point is defined (a stable loop, say); of an undefined point nothing is read. NaN or
/// infinity in a value or gradient counts as undefined. Kinks are welcome: give each smooth branch
/// as an entry of its own.
struct ConstrainedProblem {
  std::vector<double> lower, upper;
  std::size_t objectives = 1;
  std::size_t constraints = 0;
  std::function<bool(const std::vector<double>& point, ConstrainedValues& values)> evaluate;
};

struct FeasibleSearchOptions {
  /// Of one run of the optimiser; a start takes at most 2 (most_restarts + 2) runs.
  int evaluations_per_run = 150;
  /// A run is started again from where it ended, at most so often and while the last run lowered
  /// the cost by more than `worthwhile_gain`.
  int most_restarts = 4;
  double worthwhile_gain = 1e-3;
  /// A run ends when variables change less than this (relative) or the cost less than this.
  double variable_tolerance = 1e-7;
  double cost_tolerance = 1e-9;
  /// The optimiser sees every constraint raised by so much: it ends a rounding error beyond what it
  /// is told, and only points within the true constraints count.
  double reserve = 1e-8;
  /// What an undefined point costs beyond the last defined one: line searches back off.
  double undefined_penalty = 5.0;
  /// Steps from an undefined start towards a defined point.
  int retreat_steps = 12;
  /// Of all starts together.
  long most_evaluations = std::numeric_limits<long>::max();
  /// Asked before every evaluation; true ends the search, what was found stands.
  std::function<bool()> stop;
};

struct SearchPoint {
  std::vector<double> point;
  double cost = 0.0;
  double violation = 0.0;  // largest constraint
};

/// Sequential quadratic programming (NLopt's SLSQP) from one start after another, with a record of
/// its own: every evaluation is looked at here, and only points that meet every constraint can be
/// the best. The optimiser's own word is not used, its failures are counted and harmless. An
/// exception of the callback stops the optimiser and comes out of the call. Same calls, same bytes.
class FeasibleSearch {
 public:
  /// @throws InvalidInput for bounds that differ in number or are not finite and lower < upper, no
  /// objective, no callback, or options below 1 (restarts and tolerances: below 0).
  explicit FeasibleSearch(ConstrainedProblem problem, FeasibleSearchOptions options = {});

  /// The values there (cached for the last point); nothing where the point is undefined.
  /// @throws InvalidInput for a point of another size.
  const ConstrainedValues* evaluate(const std::vector<double>& point);

  /// Uniform within the bounds; the sequence depends on the generator alone.
  std::vector<double> random_point(std::mt19937_64& generator) const;

  /// The first defined point on the straight way from `from` to `towards` (itself if none is).
  /// @throws InvalidInput for points of different sizes.
  std::vector<double> retreat(const std::vector<double>& from, const std::vector<double>& towards);

  /// Searches from a start: best feasible point seen from there, if any. A start without a feasible
  /// point is continued by minimising the largest constraint, and from there again by cost. An
  /// undefined start that was not retreated from is given up at once.
  std::optional<SearchPoint> search_from(const std::vector<double>& start);

  /// Minimises the largest constraint from a start, going on beyond 0. Returns the least seen from
  /// there; nothing if no point was defined.
  std::optional<SearchPoint> approach_from(const std::vector<double>& start);

  /// The least cost of all feasible points evaluated so far.
  const std::optional<SearchPoint>& best() const { return best_; }
  /// The least violation of all defined points evaluated so far.
  const std::optional<SearchPoint>& nearest() const { return nearest_; }
  long evaluations() const { return evaluations_; }
  long undefined_evaluations() const { return undefined_; }
  int optimiser_failures() const { return failures_; }
  /// The stop predicate or the cap on all evaluations ended the search.
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
