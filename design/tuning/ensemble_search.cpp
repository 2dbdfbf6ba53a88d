#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include <boresight/design/tuning/ensemble_search.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// A constraint is violated, or another member's rms above the objective, only beyond rounding.
constexpr double rounding = 1e-9;
constexpr double above = 1e-6;

bool contains(const std::vector<std::size_t>& list, std::size_t one) {
  return std::ranges::find(list, one) != list.end();
}

}  // namespace

FeasibleSearchOptions search_options(const TuningOptions& options) {
  FeasibleSearchOptions settings;
  settings.evaluations_per_run = options.evaluations_per_start;
  settings.stop = options.stop;
  return settings;
}

EnsembleSearch::EnsembleSearch(std::vector<PlantEvaluator>& plants,
                               control::LoopStructure structure, Constraints goals,
                               const TuningOptions& options)
    : plants_(plants),
      structure_(std::move(structure)),
      goals_(std::move(goals)),
      options_(options) {
  if (options.objective.kind != ObjectiveKind::nominal) {
    for (std::size_t i = 1; i < plants.size(); ++i) {
      if (!plants[i].is_at_standstill()) ensemble_.push_back(i);
    }
  }
  if (ensemble_.empty()) ensemble_ = {0};
}

std::size_t EnsembleSearch::quantile_place() const {
  const double fraction =
      options_.objective.kind == ObjectiveKind::quantile ? options_.objective.quantile : 1.0;
  const double place = std::ceil(fraction * static_cast<double>(ensemble_.size()) - 1e-9);
  return static_cast<std::size_t>(std::max(place, 1.0)) - 1;
}

std::vector<std::size_t> EnsembleSearch::by_rising_rms() const {
  std::vector<std::size_t> order = ensemble_;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    return member_states_[i].stable ? member_states_[i].rms : infinity;
  });
  return order;
}

FixedController EnsembleSearch::evaluate(const std::vector<double>& point) {
  const control::Controller controller = controller_at(structure_, point);
  FixedController held{point, 0.0, 0.0};
  member_states_.resize(plants_.size());
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    const PlantEvaluation& plant_evaluation = plants_[i].evaluate(controller, false);
    ++evaluations_;
    member_states_[i] = {plant_evaluation.stable,
                         std::sqrt(plant_evaluation.evaluation.boresight_variance()),
                         plant_evaluation.worst_ratio(), plant_evaluation.ratios};
    held.worst_ratio = std::max(held.worst_ratio, member_states_[i].worst_ratio);
  }
  if (!std::isfinite(held.worst_ratio)) {
    held.soft_rms = infinity;
    return held;
  }
  if (options_.objective.kind == ObjectiveKind::expected) {
    for (const std::size_t i : ensemble_) held.soft_rms += std::pow(member_states_[i].rms, 2);
    held.soft_rms = std::sqrt(held.soft_rms / static_cast<double>(ensemble_.size()));
  } else {
    held.soft_rms = member_states_[by_rising_rms()[quantile_place()]].rms;
  }
  return held;
}

bool EnsembleSearch::better(const FixedController& one, const FixedController& other) const {
  const bool first = one.worst_ratio <= 1.0 + rounding;
  const bool second = other.worst_ratio <= 1.0 + rounding;
  if (first != second) return first;
  return first ? one.soft_rms < other.soft_rms : one.worst_ratio < other.worst_ratio;
}

ActiveScenarios EnsembleSearch::active_scenarios(const std::vector<std::size_t>& active) const {
  ActiveScenarios set;
  set.goals = active;
  const ObjectiveKind kind = options_.objective.kind;
  set.largest = kind == ObjectiveKind::worst_case || kind == ObjectiveKind::quantile;
  for (const std::size_t i : active) {
    if (contains(ensemble_, i) && !contains(left_out_, i)) set.rms.push_back(i);
  }
  if (set.rms.empty()) set.rms = {ensemble_.front()};
  return set;
}

ActiveScenarios EnsembleSearch::search_set() const {
  ActiveScenarios set = active_scenarios(active_);
  if (options_.objective.kind == ObjectiveKind::expected) set.rms = ensemble_;
  return set;
}

// Adds to the carried plants; whether there was anything to add.
bool EnsembleSearch::carry_more(bool feasible) {
  const auto carry = [&](std::size_t i) {
    if (contains(active_, i)) return false;
    active_.push_back(i);
    return true;
  };
  bool more = false;
  // Unstable members: two at a time, they tend to be neighbours.
  int unstable = 0;
  for (std::size_t i = 0; i < plants_.size() && unstable < 2; ++i) {
    if (!member_states_[i].stable && carry(i)) {
      more = true;
      ++unstable;
    }
  }
  // The worst member of each goal that a member outside breaks. Of an infeasible controller: what
  // stands above the worst of those inside.
  double threshold = 1.0 + rounding;
  if (!feasible) {
    for (const std::size_t i : active_) {
      if (std::isfinite(member_states_[i].worst_ratio)) {
        threshold = std::max(threshold, member_states_[i].worst_ratio * (1.0 + above));
      }
    }
  }
  struct Worst {
    std::size_t plant = 0;
    double ratio = 0.0;
  };
  std::array<std::array<Worst, control::loop_breaks.size() + 1>, goal_kinds> worst{};
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    for (const NormalisedConstraint& goal : member_states_[i].ratios) {
      const std::size_t cut = goal.loop_break ? 1 + static_cast<std::size_t>(*goal.loop_break) : 0;
      Worst& one = worst.at(static_cast<std::size_t>(goal.kind)).at(cut);
      if (goal.ratio > one.ratio) one = {i, goal.ratio};
    }
  }
  for (const auto& kind : worst) {
    for (const Worst& one : kind) {
      if (one.ratio > threshold && carry(one.plant)) more = true;
    }
  }
  const ObjectiveKind soft = options_.objective.kind;
  if ((soft != ObjectiveKind::worst_case && soft != ObjectiveKind::quantile) || unstable > 0) {
    return more;
  }
  const auto order = by_rising_rms();
  const std::size_t place = quantile_place();
  std::vector<std::size_t> left_out(order.begin() + static_cast<std::ptrdiff_t>(place) + 1,
                                    order.end());
  std::ranges::sort(left_out);
  if (left_out != left_out_) {
    left_out_ = std::move(left_out);
    more = true;
  }
  if (carry(order[place])) more = true;
  return more;
}

std::vector<std::size_t> EnsembleSearch::near_goals(const std::vector<double>& point,
                                                    std::size_t maximum) {
  constexpr double near = 0.97;
  evaluate(point);
  std::vector<std::size_t> order;
  for (std::size_t i = 1; i < plants_.size(); ++i) {
    if (member_states_[i].worst_ratio > near) order.push_back(i);
  }
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](std::size_t i) { return member_states_[i].worst_ratio; });
  order.resize(std::min(order.size(), maximum));
  order.insert(order.begin(), 0);
  return order;
}

std::optional<FixedController> EnsembleSearch::hold(const std::vector<double>& point,
                                                    const std::vector<std::size_t>& active) {
  active_ = active;
  std::vector<double> here = point;
  std::optional<FixedController> best;
  constexpr int max_rounds = 15;
  for (int round = 0; round < max_rounds; ++round) {
    FeasibleSearch search(
        controller_problem(plants_, search_set(), structure_, goals_, goal_reserve),
        search_options(options_));
    // A member just taken in may be unstable here: back to where all are stable.
    if (search.evaluate(here) == nullptr) {
      std::mt19937_64 generator(options_.seed);
      std::vector<double> anchor;
      constexpr int max_trials = 2000;
      for (int i = 0; i < max_trials && anchor.empty() && !stopped_; ++i) {
        const auto trial = search.random_point(generator);
        if (search.evaluate(trial) != nullptr) anchor = trial;
        stopped_ = stopped_ || (options_.stop && options_.stop());
      }
      if (!anchor.empty()) here = search.backtrack(here, anchor);
    }
    auto found = search.search_from(here);
    const bool feasible = found.has_value();
    if (!feasible && search.nearest()) found = search.approach_from(search.nearest()->point);
    evaluations_ += static_cast<int>(search.evaluations());
    failures_ += search.optimiser_failures();
    stopped_ = stopped_ || search.stopped();
    if (!found) break;
    here = found->point;
    FixedController held = evaluate(here);
    if (!best || better(held, *best)) best = held;
    if (plants_.size() == 1 || stopped_ || !carry_more(feasible)) break;
  }
  return best;
}

bool EnsembleSearch::stable_by_eigenvalues(const std::vector<double>& point) const {
  const control::Controller controller = controller_at(structure_, point);
  return std::ranges::all_of(plants_, [&](const PlantEvaluator& plant) {
    return plant.stable_by_eigenvalues(controller);
  });
}

Eigen::MatrixXd EnsembleSearch::soft_gradients(const control::Controller& controller) const {
  const auto size = static_cast<Eigen::Index>(controller.gains.size());
  const auto count = static_cast<Eigen::Index>(ensemble_.size());
  Eigen::MatrixXd gradients(count, size);
  Eigen::ArrayXd variances(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& evaluation =
        plants_[ensemble_[static_cast<std::size_t>(i)]].evaluate(controller, true).evaluation;
    variances[i] = evaluation.boresight_variance();
    for (Eigen::Index k = 0; k < size; ++k) {
      const auto place = static_cast<std::size_t>(k);
      gradients(i, k) =
          0.5 * (evaluation.wind_log_gradient[place] + evaluation.noise_log_gradient[place]);
    }
  }
  if (options_.objective.kind == ObjectiveKind::expected) {
    return gradients.colwise().sum() / variances.sum();
  }
  std::vector<double> sorted(variances.begin(), variances.end());
  std::ranges::sort(sorted);
  const double level = sorted[quantile_place()];
  Eigen::Index rows = 0;
  constexpr double near = 1e-4;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (std::abs(variances[i] / level - 1.0) < near) {
      gradients.row(rows++) = (gradients.row(i) / variances[i]).eval();
    }
  }
  return gradients.topRows(rows);
}

std::vector<std::string> EnsembleSearch::active_names() const {
  std::vector<std::string> names;
  for (const std::size_t i : active_) {
    if (i > 0) names.push_back(plants_[i].name());
  }
  return names;
}

}  // namespace boresight::design
