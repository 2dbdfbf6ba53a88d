#include <algorithm>
#include <cmath>
#include <numeric>

#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/matching/matching_column.hpp>
#include <boresight/design/tuning/structure_parts.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::design {
namespace {

using control::Controller;

constexpr double met = 1.0 + 1e-9;
// Of the variances: the searches' own tolerance is larger.
constexpr double quadrature_tolerance = 1e-6;

}  // namespace

MatchingColumn::MatchingColumn(const MatchingTask& task, const MatchingOptions& options,
                               const WindTable& wind,
                               const std::vector<std::vector<std::size_t>>& parts,
                               std::size_t number)
    : task_(task),
      parts_(parts),
      number_(number),
      seed_(options.seed),
      tolerance_(options.tolerance) {
  search_.seed = options.seed;
  search_.objective = task.objective;
  search_.stop = options.stop;
  const double factor = task.motor_inertia[number] / task.problem.plant.drive.motor_inertia;
  TrackingProblem problem = task.problem;
  problem.plant.drive.motor_inertia = task.motor_inertia[number];
  plants_.reserve(1 + task.members.size());
  plants_.emplace_back("", problem, task.goals, wind, quadrature_tolerance);
  TrackingProblem other = problem;
  for (const auto& member : task.members) {
    other.plant = member.plant;
    other.plant.drive.motor_inertia *= factor;
    plants_.emplace_back(member.name, other, task.goals, wind, quadrature_tolerance);
  }
  append_standstill(problem, task.goals, wind, plants_, quadrature_tolerance);
  cells_.resize(task.structures.size());
  for (auto& cell : cells_) cell.tried.assign(3 + task.structures.size(), 0);
}

SeenCell MatchingColumn::seen(std::size_t structure) const {
  const MatchingCell& cell = cells_[structure];
  return {cell.best() != nullptr ? cell.best()->point : std::vector<double>{}, cell.version};
}

void MatchingColumn::start(std::size_t structure, int starts) {
  MatchingCell& cell = cells_[structure];
  if (stopped()) return;
  cell.searched = true;
  std::mt19937_64 generator(
      numerics::splitmix64(seed_, number_ * task_.structures.size() + structure));
  random_starts(structure, {0}, starts - starts / 2, generator);
  if (plants_.size() > 1 && starts > 1) {
    random_starts(structure, cell.active, starts / 2, generator);
  } else if (starts > 1) {
    random_starts(structure, {0}, starts / 2, generator);
  }
  if (cell.best() != nullptr) cell.best_cold = std::log(cell.best()->soft_rms);
}

bool MatchingColumn::improve(std::size_t structure, const SeenCell* left, const SeenCell* right) {
  MatchingCell& cell = cells_[structure];
  const unsigned before = cell.version;
  const auto try_once = [&](std::size_t source, const SeenCell& seen,
                            const std::vector<double>& point) {
    if (point.empty() || cell.tried[source] == seen.version || stopped()) return;
    cell.tried[source] = seen.version;
    cell.searched = true;
    ++cell.warm_starts;
    attempt(structure, point);
  };
  if (left != nullptr) try_once(0, *left, left->point);
  if (right != nullptr) try_once(1, *right, right->point);
  // Between both: a search that gets stuck from either may get through from the middle.
  if (left != nullptr && right != nullptr && !left->point.empty() && !right->point.empty()) {
    std::vector<double> middle = left->point;
    for (std::size_t k = 0; k < middle.size(); ++k) {
      middle[k] = std::midpoint(middle[k], right->point[k]);
    }
    try_once(2 + cells_.size(), {middle, left->version + right->version}, middle);
  }
  for (const std::size_t other : parts_[structure]) {
    const SeenCell from = seen(other);
    if (from.point.empty()) continue;
    const Controller controller = controller_at(task_.structures[other], from.point);
    const Controller start{task_.structures[structure],
                           transferred_gains(controller, task_.structures[structure])};
    try_once(2 + other, from, log_gains(start));
  }
  return cell.version != before;
}

MatchedController MatchingColumn::finish(std::size_t structure) {
  MatchingCell& cell = cells_[structure];
  MatchedController result;
  result.searched = cell.searched;
  result.starts = static_cast<int>(cell.start_costs.size());
  result.warm_starts = cell.warm_starts;
  result.controller.structure = task_.structures[structure];
  result.worst_constraint = std::numeric_limits<double>::infinity();
  while (cell.best() != nullptr && !stable_by_eigenvalues(controller_of(structure))) {
    cell.history.pop_back();
  }
  if (cell.best() == nullptr) return result;
  const FixedController& best = *cell.best();
  result.controller = controller_of(structure);
  result.soft_rms = best.soft_rms;
  result.worst_constraint = best.worst_ratio;
  result.status = best.worst_ratio <= met ? TuningStatus::optimal : TuningStatus::infeasible;
  const double cost = std::log(best.soft_rms);
  result.gain_by_warm_starts = std::max(0.0, cell.best_cold - cost);
  result.starts_at_optimum = static_cast<int>(std::ranges::count_if(
      cell.start_costs, [&](double other) { return other < cost + std::log(1.01); }));
  for (const std::size_t i : cell.active) {
    if (i > 0) result.active_scenarios.push_back(plants_[i].name());
  }
  for (auto& plant : plants_) {
    for (const NormalisedConstraint& goal : plant.evaluate(result.controller, false).ratios) {
      if (goal.ratio > 0.9999) result.active_constraints.push_back({goal, plant.name(), 0.0});
    }
  }
  const auto& descriptions = control::gain_descriptions(result.controller.structure);
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    const double value = result.controller.gains[k];
    if (value < 1.001 * descriptions[k].lower || value > 0.999 * descriptions[k].upper) {
      result.gains_at_bound.push_back(descriptions[k].name);
    }
  }
  result.evaluation = plants_.front().evaluate(result.controller, false).evaluation;
  return result;
}

Controller MatchingColumn::controller_of(std::size_t structure) const {
  return controller_at(task_.structures[structure], cells_[structure].history.back().point);
}

// What the rational dead time leaves out is smooth and falls with the frequency: sixty points
// from where it begins are enough.
bool MatchingColumn::stable_by_eigenvalues(const Controller& controller) const {
  const auto band = analysis_band(task_.problem);
  const double highest = two_pi * band.highest;
  const double lowest = std::min(0.1 / std::max(task_.problem.delay, 1e-3), 0.1 * highest);
  const Eigen::ArrayXd frequency =
      Eigen::ArrayXd::LinSpaced(60, std::log(lowest), std::log(highest)).exp();
  return std::ranges::all_of(plants_, [&](const PlantEvaluator& plant) {
    return control::stability(plant.plant(), controller, task_.problem.delay, frequency).stable();
  });
}

FeasibleSearch MatchingColumn::search_on(std::size_t structure, const ActiveScenarios& active) {
  return FeasibleSearch(
      controller_problem(plants_, active, task_.structures[structure], task_.goals, goal_reserve),
      search_options(search_));
}

void MatchingColumn::random_starts(std::size_t structure, const std::vector<std::size_t>& active,
                                   int count, std::mt19937_64& generator) {
  EnsembleSearch ensemble(plants_, task_.structures[structure], task_.goals, search_);
  FeasibleSearch search = search_on(structure, ensemble.active_scenarios(active));
  constexpr std::size_t enough_anchors = 4;
  constexpr int max_trials = 1000;
  std::vector<std::vector<double>> anchors;
  for (int i = 0; i < max_trials && anchors.size() < enough_anchors && !stopped(); ++i) {
    auto point = search.random_point(generator);
    if (search.evaluate(point) != nullptr) anchors.push_back(std::move(point));
  }
  std::vector<SearchPoint> ends;
  for (int i = 0; i < count && !anchors.empty(); ++i) {
    const auto from = search.random_point(generator);
    const auto start =
        search.backtrack(from, anchors[static_cast<std::size_t>(i) % anchors.size()]);
    if (auto end = search.search_from(start)) ends.push_back(std::move(*end));
  }
  if (const auto& nearest = search.nearest(); ends.empty() && nearest) ends.push_back(*nearest);
  evaluations_ += search.evaluations() * static_cast<long>(active.size());
  std::ranges::stable_sort(ends, {}, &SearchPoint::cost);
  // Ends far above the best, or copies of it, are not worth holding on every plant.
  constexpr double far = 0.2, apart = 1e-3;
  double last = -std::numeric_limits<double>::infinity();
  for (const auto& end : ends) {
    if (end.cost > ends.front().cost + far) break;
    double held = end.cost;
    if (end.cost > last + apart) held = attempt(structure, end.point).value_or(end.cost);
    last = end.cost;
    cells_[structure].start_costs.push_back(held);
  }
}

// Holds a start on every plant; ln rms where that ended.
std::optional<double> MatchingColumn::attempt(std::size_t structure,
                                              const std::vector<double>& point) {
  MatchingCell& cell = cells_[structure];
  const Controller controller = controller_at(task_.structures[structure], point);
  for (const std::size_t i : cell.active) {
    ++evaluations_;
    if (!plants_[i].evaluate(controller, false).stable) return std::nullopt;
  }
  EnsembleSearch ensemble(plants_, task_.structures[structure], task_.goals, search_);
  const auto held = ensemble.hold(point, cell.active);
  evaluations_ += ensemble.evaluations();
  if (!held) return std::nullopt;
  if (cell.best() == nullptr || clearly_better(ensemble, *held, *cell.best())) {
    cell.history.push_back(*held);
    cell.active = worth_carrying(ensemble.active(), controller_of(structure));
    ++cell.version;
  }
  return held->worst_ratio <= met ? std::optional(std::log(held->soft_rms)) : std::nullopt;
}

bool MatchingColumn::clearly_better(const EnsembleSearch& ensemble, const FixedController& one,
                                    const FixedController& other) const {
  if (!ensemble.better(one, other)) return false;
  const bool both = one.worst_ratio <= met && other.worst_ratio <= met;
  if (both) return one.soft_rms < other.soft_rms * (1.0 - tolerance_);
  return one.worst_ratio <= met || one.worst_ratio < other.worst_ratio * (1.0 - tolerance_);
}

// The plants near one of their goals, or with a rms near the largest; the others come back if
// they have to.
std::vector<std::size_t> MatchingColumn::worth_carrying(const std::vector<std::size_t>& active,
                                                        const Controller& controller) {
  constexpr double near = 0.97;
  const bool largest = task_.objective.kind == ObjectiveKind::worst_case ||
                       task_.objective.kind == ObjectiveKind::quantile;
  std::vector<std::size_t> kept;
  for (const std::size_t i : active) {
    if (i == 0 || largest || plants_[i].evaluate(controller, false).worst_ratio() > near)
      kept.push_back(i);
  }
  return kept;
}

}  // namespace boresight::design
