#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>

#include <boresight/design/tuning/active_multipliers.hpp>
#include <boresight/design/tuning/ensemble_search.hpp>
#include <boresight/design/tuning/tuner.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

// A goal met to the last digit is met.
constexpr double rounding = 1e-9;

void check(const control::LoopStructure& structure, const Constraints& goals,
           const TuningOptions& options) {
  const int min_starts = options.warm_starts.empty() ? 1 : 0;
  if (options.starts < min_starts || options.evaluations_per_start < 1) {
    throw InvalidInput(
        fmt::format("tune: expected at least {} starts and 1 evaluation a start, found {} and {}",
                    min_starts, options.starts, options.evaluations_per_start));
  }
  const double quantile = options.objective.quantile;
  if (!std::isfinite(quantile) || quantile <= 0.0 || quantile > 1.0) {
    throw InvalidInput(
        fmt::format("tune: expected a quantile above 0 and at most 1, found {:g}", quantile));
  }
  for (const auto& gains : options.warm_starts) {
    control::validate({structure, gains});
  }
  validate(goals);
}

std::vector<PlantEvaluator> make_plants(const TrackingProblem& problem, const Constraints& goals,
                                        const std::vector<EnsembleMember>& members) {
  const WindTable wind(problem);
  std::vector<PlantEvaluator> plants;
  plants.reserve(1 + members.size());
  plants.emplace_back("", problem, goals, wind);
  TrackingProblem other = problem;
  for (const auto& member : members) {
    other.plant = member.plant;
    plants.emplace_back(member.name, other, goals, wind);
  }
  append_standstill(problem, goals, wind, plants);
  return plants;
}

struct Started {
  std::vector<SearchPoint> feasible;  // one a start at most, best first
  std::vector<SearchPoint> nearest;   // where none is feasible
};

// All starts on some of the plants. Each start has a record of its own, so that threads make no
// difference.
Started multi_start(const std::vector<PlantEvaluator>& plants, const ActiveScenarios& active,
                    const control::LoopStructure& structure, const Constraints& goals,
                    const TuningOptions& options, TuningResult& result) {
  const FeasibleSearchOptions settings = search_options(options);
  std::vector<PlantEvaluator> own = plants;
  FeasibleSearch trial(controller_problem(own, active, structure, goals, goal_reserve), settings);
  std::mt19937_64 generator(options.seed);
  // Stable points that unstable starts are pulled back to: several, or all would end in the valleys
  // around one.
  std::vector<std::vector<double>> anchors;
  constexpr std::size_t enough_anchors = 10;
  constexpr int max_trials = 2000;
  for (int i = 0; i < max_trials && anchors.size() < enough_anchors; ++i) {
    if (options.stop && options.stop()) break;
    auto point = trial.random_point(generator);
    if (trial.evaluate(point) != nullptr) anchors.push_back(std::move(point));
  }
  result.evaluations += static_cast<int>(trial.evaluations());
  if (anchors.empty()) return {};

  struct Outcome {
    std::optional<SearchPoint> best, nearest;
    int evaluations = 0, failures = 0;
    bool stopped = false;
  };
  std::vector<std::vector<double>> starts;
  for (int i = 0; i < options.starts; ++i) starts.push_back(trial.random_point(generator));
  std::vector<Outcome> outcomes(starts.size());
  const std::size_t threads =
      std::clamp<std::size_t>(options.threads, 1, std::max<std::size_t>(starts.size(), 1));
  numerics::for_each_index(threads, static_cast<unsigned>(threads), [&](std::size_t thread) {
    std::vector<PlantEvaluator> mine = plants;
    for (std::size_t i = thread; i < starts.size(); i += threads) {
      // Even when stopped the first start is looked at: something stands.
      if (i > 0 && options.stop && options.stop()) {
        outcomes[i].stopped = true;
        break;
      }
      FeasibleSearch search(controller_problem(mine, active, structure, goals, goal_reserve),
                            settings);
      outcomes[i].best =
          search.search_from(search.backtrack(starts[i], anchors[i % anchors.size()]));
      outcomes[i].nearest = search.nearest();
      outcomes[i].evaluations = static_cast<int>(search.evaluations());
      outcomes[i].failures = search.optimiser_failures();
      outcomes[i].stopped = search.stopped();
    }
  });
  Started started;
  for (auto& outcome : outcomes) {
    if (outcome.best) started.feasible.push_back(std::move(*outcome.best));
    if (outcome.nearest) started.nearest.push_back(std::move(*outcome.nearest));
    result.evaluations += outcome.evaluations;
    result.optimiser_failures += outcome.failures;
    result.interrupted = result.interrupted || outcome.stopped;
  }
  std::ranges::stable_sort(started.feasible, {}, &SearchPoint::cost);
  std::ranges::stable_sort(started.nearest, {}, &SearchPoint::violation);
  return started;
}

// The first `count` that are not copies of one another, of what is sorted by a value.
std::vector<std::vector<double>> distinct(const std::vector<SearchPoint>& sorted,
                                          double SearchPoint::*value, std::size_t count) {
  constexpr double apart = 5e-5;
  std::vector<std::vector<double>> chosen;
  double last = -std::numeric_limits<double>::infinity();
  for (const auto& one : sorted) {
    if (chosen.size() == count) break;
    if (one.*value < last + apart) continue;
    last = one.*value;
    chosen.push_back(one.point);
  }
  return chosen;
}

std::vector<std::vector<double>> promising(const Started& started) {
  constexpr std::size_t maximum = 3;
  if (!started.feasible.empty()) return distinct(started.feasible, &SearchPoint::cost, maximum);
  return distinct(started.nearest, &SearchPoint::violation, 2);
}

// Random starts on the problem's own plant; with members, again with those that have to be carried.
std::vector<std::vector<double>> global_search(std::vector<PlantEvaluator>& plants,
                                               const control::LoopStructure& structure,
                                               const Constraints& goals,
                                               const TuningOptions& options,
                                               std::vector<std::size_t>& active,
                                               TuningResult& result) {
  Started started = multi_start(plants, {{0}, {0}, false}, structure, goals, options, result);
  auto points = promising(started);
  if (plants.size() > 1 && !points.empty() && !result.interrupted) {
    EnsembleSearch ensemble(plants, structure, goals, options);
    const auto held = ensemble.hold(points.front(), {0});
    result.evaluations += ensemble.evaluations();
    active = ensemble.active();
    const ActiveScenarios many = ensemble.active_scenarios(active);
    Started again = multi_start(plants, many, structure, goals, options, result);
    if (!again.feasible.empty() || started.feasible.empty()) started = std::move(again);
    points = promising(started);
    if (held) points.push_back(held->point);
  }
  if (!started.feasible.empty()) {
    const double best = started.feasible.front().cost;
    result.starts_at_optimum = static_cast<int>(std::ranges::count_if(
        started.feasible, [&](const auto& one) { return one.cost < best + std::log(1.01); }));
  }
  return points;
}

// Prices of what holds the controller, by the multipliers of the goals that are active on any
// plant.
void describe_limits(std::vector<PlantEvaluator>& plants, const EnsembleSearch& ensemble,
                     TuningResult& result) {
  const auto& descriptions = control::gain_descriptions(result.controller.structure);
  const auto size = static_cast<Eigen::Index>(descriptions.size());
  const bool feasible = result.status == TuningStatus::optimal;
  std::vector<ActiveConstraint> binding;
  for (auto& plant : plants) {
    for (const NormalisedConstraint& goal : plant.evaluate(result.controller, true).ratios) {
      if (goal.ratio > 0.999) {
        result.active_constraints.push_back(
            describe(goal) + (plant.name().empty() ? "" : fmt::format(", on {}", plant.name())));
      }
      const double threshold = feasible ? 1.0 : result.worst_constraint;
      if (goal.ratio > threshold * (1.0 - 1e-4)) binding.push_back({goal, plant.name(), 0.0});
    }
  }
  // Nothing to price where the encirclements and the eigenvalues differ on a member.
  if (!feasible && binding.empty()) return;
  const auto row = [&](const std::array<double, control::max_gains>& gradient) {
    return Eigen::Map<const Eigen::RowVectorXd>(gradient.data(), size);
  };
  ActiveSet set;
  const auto goals = static_cast<Eigen::Index>(binding.size());
  Eigen::MatrixXd gradients(goals, size);
  for (Eigen::Index i = 0; i < goals; ++i) {
    gradients.row(i) = row(binding[static_cast<std::size_t>(i)].goal.log_gradient);
  }
  set.constraints.resize(0, size);
  set.objectives = std::move(gradients);
  if (feasible) {
    set.constraints = std::move(set.objectives);
    set.objectives = ensemble.soft_gradients(result.controller);
  }
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    const double value = result.controller.gains[k];
    set.at_lower.push_back(value < 1.001 * descriptions[k].lower);
    set.at_upper.push_back(value > 0.999 * descriptions[k].upper);
    if (set.at_lower.back() || set.at_upper.back()) {
      result.gains_at_bound.push_back(descriptions[k].name);
    }
  }
  const Multipliers found = active_multipliers(set);
  result.gradient_residual = found.residual;
  const Eigen::VectorXd& shadow_prices = feasible ? found.constraints : found.objectives;
  constexpr double worth_saying = 1e-4;
  for (std::size_t i = 0; i < binding.size(); ++i) {
    binding[i].shadow_price = shadow_prices[static_cast<Eigen::Index>(i)];
    if (binding[i].shadow_price > worth_saying) result.limits.push_back(std::move(binding[i]));
  }
  std::ranges::stable_sort(result.limits, std::ranges::greater(), &ActiveConstraint::shadow_price);
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    const auto place = static_cast<Eigen::Index>(k);
    for (const bool upper : {false, true}) {
      const double shadow_price = upper ? found.upper[place] : found.lower[place];
      if (shadow_price > worth_saying) {
        result.limiting_bounds.push_back({descriptions[k].name, upper, shadow_price});
      }
    }
  }
}

}  // namespace

std::string ActiveConstraint::description() const {
  return fmt::format("{}{}: relaxing it by 1 % lowers the rms by {:.2f} %", describe(goal),
                     member.empty() ? "" : fmt::format(", on {}", member), shadow_price);
}

double worst_constraint(const control::LoopEvaluation& evaluation, const Constraints& goals) {
  if (!evaluation.stable()) return std::numeric_limits<double>::infinity();
  double worst = std::sqrt(evaluation.effort_variance) / goals.control_effort;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    worst = std::max(worst,
                     evaluation.highest_peak(control::loop_breaks[b]) / goals.sensitivity_peak[b]);
  }
  return worst;
}

TuningResult tune(const TrackingProblem& problem, const control::LoopStructure& structure,
                  const Constraints& goals, const TuningOptions& options) {
  check(structure, goals, options);
  TuningResult result;
  result.starts = options.starts;
  result.controller.structure = structure;
  std::vector<PlantEvaluator> plants = make_plants(problem, goals, options.members);
  std::vector<std::size_t> active{0};
  std::vector<std::vector<double>> points;
  for (const auto& gains : options.warm_starts) points.push_back(log_gains({structure, gains}));
  if (options.starts > 0) {
    const auto found = global_search(plants, structure, goals, options, active, result);
    points.insert(points.end(), found.begin(), found.end());
  }
  EnsembleSearch ensemble(plants, structure, goals, options);
  std::optional<FixedController> chosen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Without the active constraints of a warm start the search would leave it for the nominal
    // optimum.
    constexpr std::size_t max_active = 8;
    const bool warm = i < options.warm_starts.size();
    const auto held =
        ensemble.hold(points[i], warm ? ensemble.near_goals(points[i], max_active) : active);
    if (held && (!chosen || ensemble.better(*held, *chosen)) &&
        ensemble.stable_by_eigenvalues(held->point)) {
      chosen = held;
      result.active_scenarios = ensemble.active_names();
    }
  }
  result.evaluations += ensemble.evaluations();
  result.optimiser_failures += ensemble.failures();
  result.interrupted = result.interrupted || ensemble.stopped();
  if (!chosen) {
    result.status = TuningStatus::unstable;
    result.worst_constraint = std::numeric_limits<double>::infinity();
    return result;
  }
  result.controller = controller_at(structure, chosen->point);
  result.evaluation = plants.front().evaluate(result.controller, true).evaluation;
  result.worst_constraint = chosen->worst_ratio;
  result.soft_rms = chosen->soft_rms;
  result.status =
      chosen->worst_ratio <= 1.0 + rounding ? TuningStatus::optimal : TuningStatus::infeasible;
  describe_limits(plants, ensemble, result);
  return result;
}

}  // namespace boresight::design
