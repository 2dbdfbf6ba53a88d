#include <algorithm>
#include <cmath>
#include <exception>

#include <fmt/format.h>
#include <nlopt.hpp>

#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

double largest(const std::vector<double>& values) {
  return values.empty() ? -std::numeric_limits<double>::infinity() : std::ranges::max(values);
}

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

void check(const ConstrainedProblem& problem, const FeasibleSearchOptions& options) {
  if (problem.lower.empty() || problem.lower.size() != problem.upper.size()) {
    throw InvalidInput(
        fmt::format("FeasibleSearch: expected as many lower as upper bounds, at least one, found "
                    "{} and {}",
                    problem.lower.size(), problem.upper.size()));
  }
  for (std::size_t k = 0; k < problem.lower.size(); ++k) {
    const double lower = problem.lower[k], upper = problem.upper[k];
    if (!std::isfinite(lower) || !std::isfinite(upper) || lower >= upper) {
      throw InvalidInput(
          fmt::format("FeasibleSearch: expected finite bounds with lower < upper, found {} and {} "
                      "for variable {}",
                      lower, upper, k));
    }
  }
  if (problem.objectives == 0 || !problem.evaluate) {
    throw InvalidInput("FeasibleSearch: expected at least one objective and a callback");
  }
  if (options.evaluations_per_run < 1 || options.backtrack_steps < 1 ||
      options.max_evaluations < 1 || options.max_restarts < 0) {
    throw InvalidInput(fmt::format(
        "FeasibleSearch: expected at least 1 evaluation a run and in all, 1 backtracking "
        "step and 0 restarts, found {}, {}, {}, {}",
        options.evaluations_per_run, options.max_evaluations, options.backtrack_steps,
        options.max_restarts));
  }
  if (!(options.variable_tolerance >= 0.0) || !(options.cost_tolerance >= 0.0) ||
      !(options.worthwhile_gain >= 0.0) || !(options.reserve >= 0.0) ||
      !(options.undefined_penalty > 0.0)) {
    throw InvalidInput(
        fmt::format("FeasibleSearch: expected tolerances, gain and reserve of 0 or more and a "
                    "positive penalty, found {}, {}, {}, {}, {}",
                    options.variable_tolerance, options.cost_tolerance, options.worthwhile_gain,
                    options.reserve, options.undefined_penalty));
  }
}

}  // namespace

double ConstrainedValues::cost() const {
  return largest(objectives);
}
double ConstrainedValues::violation() const {
  return largest(constraints);
}

FeasibleSearch::FeasibleSearch(ConstrainedProblem problem, FeasibleSearchOptions options)
    : problem_(std::move(problem)), options_(std::move(options)) {
  check(problem_, options_);
  const std::size_t size = problem_.lower.size();
  values_.objectives.resize(problem_.objectives);
  values_.objective_gradients.resize(problem_.objectives * size);
  values_.constraints.resize(problem_.constraints);
  values_.constraint_gradients.resize(problem_.constraints * size);
}

bool FeasibleSearch::finite_values() const {
  return all_finite(values_.objectives) && all_finite(values_.objective_gradients) &&
         all_finite(values_.constraints) && all_finite(values_.constraint_gradients);
}

const ConstrainedValues* FeasibleSearch::evaluate(const std::vector<double>& point) {
  if (point.size() != problem_.lower.size()) {
    throw InvalidInput(fmt::format("FeasibleSearch: expected a point of {} variables, found {}",
                                   problem_.lower.size(), point.size()));
  }
  if (point != point_) {
    point_.clear();  // no value stands for a point whose evaluation throws
    ++evaluations_;
    defined_ = problem_.evaluate(point, values_) && finite_values();
    point_ = point;
    if (defined_) {
      consider(point);
    } else {
      ++undefined_;
    }
  }
  return defined_ ? &values_ : nullptr;
}

void FeasibleSearch::consider(const std::vector<double>& point) {
  const double cost = values_.cost(), violation = values_.violation();
  const auto keep = [&](std::optional<SearchPoint>& record) {
    if (!record) record.emplace();
    record->point = point;
    record->cost = cost;
    record->violation = violation;
  };
  if (violation <= 0.0) {
    if (!best_ || cost < best_->cost) keep(best_);
    if (!start_best_ || cost < start_best_->cost) keep(start_best_);
  }
  if (!nearest_ || violation < nearest_->violation) keep(nearest_);
  if (!start_nearest_ || violation < start_nearest_->violation) keep(start_nearest_);
}

std::vector<double> FeasibleSearch::random_point(std::mt19937_64& generator) const {
  std::vector<double> point(problem_.lower.size());
  for (std::size_t k = 0; k < point.size(); ++k) {
    // 53 random bits, so that the sequence does not depend on the standard library.
    const double fraction = static_cast<double>(generator() >> 11) * 0x1p-53;
    point[k] = problem_.lower[k] + fraction * (problem_.upper[k] - problem_.lower[k]);
  }
  return point;
}

std::vector<double> FeasibleSearch::backtrack(const std::vector<double>& from,
                                              const std::vector<double>& towards) {
  if (from.size() != towards.size()) {
    throw InvalidInput(
        fmt::format("FeasibleSearch: expected two points of one size, found {} and {}", from.size(),
                    towards.size()));
  }
  std::vector<double> point = from;
  for (int step = 0; step < options_.backtrack_steps; ++step) {
    for (std::size_t k = 0; k < point.size(); ++k) {
      point[k] = from[k] + (towards[k] - from[k]) * step / options_.backtrack_steps;
    }
    if (evaluate(point) != nullptr) return point;
  }
  return towards;
}

// Answers the optimiser's calls during one run. With more than one objective a variable t is added:
// least t with every objective at most t.
struct FeasibleSearch::Run {
  FeasibleSearch& search;
  Aim aim;
  bool until_feasible;
  nlopt::opt* optimiser = nullptr;
  std::exception_ptr failure;
  bool ended = false;  // by us
  std::vector<double> point;
  double last_cost = 0.0;
  // Constraints of the last defined point: an undefined one shows these, its cost raised.
  std::vector<double> last_constraints;

  std::size_t size() const { return search.problem_.lower.size(); }
  const std::vector<double>& objectives() const {
    return aim == Aim::cost ? search.values_.objectives : search.values_.constraints;
  }
  const std::vector<double>& objective_gradients() const {
    return aim == Aim::cost ? search.values_.objective_gradients
                            : search.values_.constraint_gradients;
  }
  bool bounded() const { return objectives().size() > 1; }
  std::size_t constraint_count() const {
    return (bounded() ? objectives().size() : 0) +
           (aim == Aim::cost ? search.values_.constraints.size() : 0);
  }

  const ConstrainedValues* values_at(const double* variables) {
    point.assign(variables, variables + size());
    if (!all_finite(point)) {
      // It happens where its quadratic programme breaks down: from there on nothing else comes.
      ++search.failures_;
      throw nlopt::forced_stop();
    }
    // The optimiser steps beyond its bounds by a rounding error.
    for (std::size_t k = 0; k < size(); ++k) {
      point[k] = std::clamp(point[k], search.problem_.lower[k], search.problem_.upper[k]);
    }
    const bool known = point == search.point_;
    if (!known && ((search.options_.stop && search.options_.stop()) ||
                   search.evaluations_ >= search.options_.max_evaluations)) {
      search.stopped_ = true;
      throw nlopt::forced_stop();
    }
    const ConstrainedValues* values = search.evaluate(point);
    if (until_feasible && values != nullptr && values->violation() <= -search.options_.reserve) {
      throw nlopt::forced_stop();
    }
    return values;
  }

  // NLopt swallows exceptions thrown through C: ours are kept and thrown again after the run.
  template <typename Function>
  void guarded(Function function) {
    try {
      function();
    } catch (const nlopt::forced_stop&) {
      ended = true;
      optimiser->force_stop();
    } catch (...) {
      failure = std::current_exception();
      ended = true;
      optimiser->force_stop();
    }
  }

  static double objective(unsigned size, const double* variables, double* gradient, void* data) {
    auto& run = *static_cast<Run*>(data);
    if (gradient != nullptr) std::fill(gradient, gradient + size, 0.0);
    double cost = run.last_cost + run.search.options_.undefined_penalty;
    run.guarded([&] {
      const bool defined = run.values_at(variables) != nullptr;
      if (run.bounded()) {
        const double bound = variables[size - 1];
        if (defined) run.last_cost = bound;
        cost = defined ? bound : run.last_cost + run.search.options_.undefined_penalty;
        if (gradient != nullptr) gradient[size - 1] = 1.0;
      } else if (defined) {
        cost = run.last_cost = run.objectives().front();
        if (gradient != nullptr) std::ranges::copy(run.objective_gradients(), gradient);
      }
    });
    return cost;
  }

  static void constraints(unsigned count, double* values, unsigned size, const double* variables,
                          double* gradients, void* data) {
    auto& run = *static_cast<Run*>(data);
    if (gradients != nullptr) std::fill(gradients, gradients + std::size_t{count} * size, 0.0);
    std::ranges::copy(run.last_constraints, values);
    run.guarded([&] {
      const ConstrainedValues* found = run.values_at(variables);
      if (found == nullptr) return;
      std::size_t row = 0;
      const auto add = [&](const std::vector<double>& entries, const std::vector<double>& rows,
                           bool below_bound) {
        for (std::size_t i = 0; i < entries.size(); ++i, ++row) {
          values[row] = below_bound ? entries[i] - variables[size - 1]
                                    : entries[i] + run.search.options_.reserve;
          if (gradients == nullptr) continue;
          std::copy_n(rows.data() + i * run.size(), run.size(), gradients + row * size);
          if (below_bound) gradients[row * size + size - 1] = -1.0;
        }
      };
      if (run.bounded()) add(run.objectives(), run.objective_gradients(), true);
      if (run.aim == Aim::cost) add(found->constraints, found->constraint_gradients, false);
      std::copy(values, values + count, run.last_constraints.begin());
    });
  }
};

void FeasibleSearch::run(Aim aim, const std::vector<double>& start, bool until_feasible) {
  Run answers{*this, aim, until_feasible, nullptr, nullptr, false, {}, 0.0, {}};
  const ConstrainedValues* first = evaluate(start);
  if (first == nullptr || answers.objectives().empty()) return;
  const std::size_t size = start.size() + (answers.bounded() ? 1 : 0);
  std::vector<double> variables = start, lower = problem_.lower, upper = problem_.upper;
  answers.last_cost = largest(answers.objectives());
  if (answers.bounded()) {
    variables.push_back(answers.last_cost);
    lower.push_back(-HUGE_VAL);
    upper.push_back(HUGE_VAL);
  }
  nlopt::opt optimiser(nlopt::LD_SLSQP, static_cast<unsigned>(size));
  optimiser.set_lower_bounds(lower);
  optimiser.set_upper_bounds(upper);
  optimiser.set_maxeval(options_.evaluations_per_run);
  optimiser.set_xtol_rel(options_.variable_tolerance);
  optimiser.set_ftol_abs(options_.cost_tolerance);
  answers.optimiser = &optimiser;
  optimiser.set_min_objective(Run::objective, &answers);
  answers.last_constraints.assign(answers.constraint_count(), 0.0);
  if (answers.constraint_count() > 0) {
    optimiser.add_inequality_mconstraint(Run::constraints, &answers,
                                         std::vector<double>(answers.constraint_count(), 0.0));
  }
  try {
    double value = 0.0;
    optimiser.optimize(variables, value);
  } catch (const std::runtime_error&) {
    // A failed line search, rounding, or our own stop: the record stands all the same.
    if (!answers.ended) ++failures_;
  }
  if (answers.failure) std::rethrow_exception(answers.failure);
}

void FeasibleSearch::begin(const std::vector<double>& start) {
  start_best_.reset();
  start_nearest_.reset();
  // Evaluated already, by backtrack(), say: it counts for this start too.
  if (start == point_ && defined_) consider(start);
}

std::optional<SearchPoint> FeasibleSearch::search_from(const std::vector<double>& start) {
  begin(start);
  std::vector<double> point = start;
  // SLSQP stops where two branches change places; from there it often goes on with the new pair.
  double cost = std::numeric_limits<double>::infinity();
  for (int again = 0; again <= options_.max_restarts && !stopped_; ++again) {
    run(Aim::cost, point, false);
    if (!start_best_ && start_nearest_ && !stopped_) {
      run(Aim::constraints, start_nearest_->point, true);
    }
    if (!start_best_) break;
    const bool worthwhile = start_best_->cost < cost - options_.worthwhile_gain;
    cost = start_best_->cost;
    point = start_best_->point;
    if (!worthwhile) break;
  }
  return start_best_;
}

std::optional<SearchPoint> FeasibleSearch::approach_from(const std::vector<double>& start) {
  begin(start);
  std::vector<double> point = start;
  double violation = std::numeric_limits<double>::infinity();
  for (int again = 0; again <= options_.max_restarts && !stopped_; ++again) {
    run(Aim::constraints, point, false);
    if (!start_nearest_ || start_nearest_->violation >= violation - options_.worthwhile_gain) break;
    violation = start_nearest_->violation;
    point = start_nearest_->point;
  }
  return start_nearest_;
}

}  // namespace boresight::design
