#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/lqg/noise_effort_lqg.hpp>
#include <boresight/design/limits/controller_refinement.hpp>
#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/design/problem/mean_wind_load.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// The controller's poles, of a damping ratio of 0.05 or more, turn the return difference between
// the plants' modes: enough points for SampledSetting::highest_peak to interpolate it.
constexpr int points_per_decade = 100;

// Frequencies that show the peaks of every plant: each one's own grid, put together.
Eigen::ArrayXd peak_frequencies(const TrackingProblem& problem,
                                const std::vector<EnsembleMember>& members, double sample_time) {
  const double nyquist = 0.5 / sample_time;
  std::vector<double> all;
  const auto add = [&](const plant::AntennaPlant& plant) {
    const Eigen::ArrayXd grid =
        plant::frequency_grid(plant, 1e-3, 0.9999 * nyquist, points_per_decade);
    all.insert(all.end(), grid.begin(), grid.end());
  };
  add(problem.plant);
  for (const EnsembleMember& member : members) add(member.plant);
  std::ranges::sort(all);
  std::vector<double> kept;
  for (const double w : all) {
    if (w >= two_pi * nyquist) break;
    if (kept.empty() || w > kept.back() * (1.0 + 1e-5)) kept.push_back(w);
  }
  return Eigen::Map<Eigen::ArrayXd>(kept.data(), static_cast<Eigen::Index>(kept.size()));
}

// Those of the constraint, and slopes of smaller oscillations: an LQG estimates the wind from the
// torque, which drives a motor that friction holds ever further, so that it may limit-cycle slowly.
std::vector<double> standstill_slopes(const Standstill& standstill) {
  std::vector<double> slopes = standstill.friction;
  if (slopes.empty()) return slopes;
  const double largest = *std::ranges::max_element(slopes);
  for (const double factor : {3.0, 10.0}) slopes.push_back(factor * largest);
  return slopes;
}

// Fractions of the allowed Ms - 1 and control effort that the design uses. The rest is a reserve
// for plants other than members and corners (docs/limit-cycles.md: what part of sampled plants
// keeps the constraints).
constexpr double used_of_peak = 0.70, used_of_effort = 0.97;
// N m s/rad: with so much friction the motor does not move.
constexpr double locking_friction = 1e7;
// Limits of the gain from encoder to motor torque with the motor locked, over
// Standstill::breakaway_stiffness, tried in this order: empirical.
constexpr std::array<double, 2> locked_motor_gains{5.0, 4.0};
// Bounds of a refined controller's poles. A slower pole would leave an error for minutes after a
// slew; a less damped one would fit a resonance of one plant.
constexpr PoleBounds pole_bounds{.slowest = 0.25, .damping = 0.05};
constexpr int steps_from_loops = 90;
// Pairs of poles that a refined controller has beside those of its start, an octave apart about the
// hydraulic mode, where its loop crosses over: multiples of that mode's frequency.
constexpr std::array<double, 5> further_frequencies{0.3, 0.6, 1.2, 2.4, 4.8};
constexpr double damping_of_further_pairs = 0.5;

std::vector<double> further_pairs(const plant::AntennaPlant& plant) {
  std::vector<double> result;
  try {
    const double mode = two_pi * plant::hydraulic_mode(plant::plant_modes(plant)).frequency;
    for (const double factor : further_frequencies) {
      const double frequency = factor * mode;
      if (damping_of_further_pairs * frequency > pole_bounds.slowest) result.push_back(frequency);
    }
  } catch (const NumericalFailure&) {
    result.clear();  // without a hydraulic mode there is nothing to place them by
  }
  return result;
}

// The settings; then, if there are any, none.
std::vector<std::span<const SampledSetting>> with_and_without(
    const std::vector<SampledSetting>& settings) {
  std::vector<std::span<const SampledSetting>> result{settings};
  if (!settings.empty()) result.emplace_back();
  return result;
}

// What a condition may cost of the rms.
constexpr double price = 0.05;

// Nothing is left to gain by other conditions: no violations, and what it takes to have none costs
// little rms.
bool is_settled(const RefinementResult& result) {
  return result.feasible && result.violations.value_or(0) == 0 &&
         result.boresight_rms < (1.0 + price) * result.last_rms;
}

// Whether to take the result of fewer conditions: if it alone is feasible, has fewer violations, or
// has less rms by more than their price.
bool is_better(const RefinementResult& one, const RefinementResult& than) {
  const auto rank = [](const RefinementResult& result) {
    return std::pair(!result.feasible, result.violations.value_or(std::numeric_limits<int>::max()));
  };
  if (rank(one) != rank(than)) return rank(one) < rank(than);
  return (1.0 + price) * one.boresight_rms < than.boresight_rms;
}

// Which Constraints::static_encoder_error asks of a controller without integral on every plant;
// none with a limit of 0, which only an integral meets.
std::optional<double> min_static_gain(const TrackingProblem& problem, const Constraints& goals,
                                      const std::vector<EnsembleMember>& members) {
  if (!(goals.static_encoder_error.value_or(0.0) > 0.0)) return std::nullopt;
  double demand = std::abs(mean_wind_load(problem).demand);
  TrackingProblem other = problem;
  for (const EnsembleMember& member : members) {
    other.plant = member.plant;
    demand = std::max(demand, std::abs(mean_wind_load(other).demand));
  }
  if (!(demand > 0.0)) return std::nullopt;
  return demand / (*goals.static_encoder_error * problem.gear_ratio);
}

class Study {
 public:
  Study(const TrackingProblem& problem, const Constraints& goals,
        const std::vector<EnsembleMember>& members, const PointingLimitOptions& options)
      : threads_(options.threads),
        start_(options.start),
        violations_(options.violations),
        ratio_(problem.gear_ratio),
        goals_{goals.sensitivity_peak[1], goals.control_effort},
        filter_(fit_wind_filter(problem)) {
    std::vector<EnsembleMember> standing;
    if (goals.standstill) {
      goals_.standstill_peak = goals.standstill->sensitivity_peak;
      for (const double friction : standstill_slopes(*goals.standstill)) {
        standing.push_back({fmt::format("friction {:.3g} N.m.s/rad", friction), problem.plant});
        standing.back().plant.drive.viscous_friction = friction;
      }
    }
    std::vector<EnsembleMember> all = members;
    all.insert(all.end(), standing.begin(), standing.end());
    all.insert(all.end(), options.corners.begin(), options.corners.end());
    std::vector<EnsembleMember> at_edges;
    if (goals.standstill) {
      for (const Standstill::Edge& edge : goals.standstill->edges) {
        at_edges.push_back(
            {fmt::format("edge, friction {:.3g} N.m.s/rad", edge.friction), problem.plant});
        at_edges.back().plant.drive.viscous_friction = edge.friction;
      }
    }
    all.insert(all.end(), at_edges.begin(), at_edges.end());
    const Eigen::ArrayXd frequency = peak_frequencies(problem, all, options.sample_time);
    const auto add = [&](std::vector<SampledSetting>& to, const std::string& name,
                         const plant::AntennaPlant& plant) {
      to.emplace_back(name, plant, filter_, problem.noise, options.sample_time, frequency);
    };
    add(settings_, "nominal", problem.plant);
    for (const EnsembleMember& member : members) add(settings_, member.name, member.plant);
    for (const EnsembleMember& corner : options.corners) add(corners_, corner.name, corner.plant);
    for (const EnsembleMember& member : standing) add(at_standstill_, member.name, member.plant);
    refined_goals_ = goals_;
    refined_goals_.sensitivity_peak = 1.0 + used_of_peak * (goals_.sensitivity_peak - 1.0);
    refined_goals_.control_effort *= used_of_effort;
    refined_goals_.position_peak = goals.sensitivity_peak[2];
    refined_goals_.static_gain = min_static_gain(problem, goals, members);
    if (!goals.standstill) return;
    stated_slopes_ = goals.standstill->friction.size();
    for (std::size_t i = 0; i < at_edges.size(); ++i) {
      at_edges_.emplace_back(at_edges[i].name, at_edges[i].plant, filter_, problem.noise,
                             options.sample_time, frequency,
                             goals.standstill->edges[i].encoder_gain);
    }
    breakaway_stiffness_ = goals.standstill->breakaway_stiffness;
    if (!breakaway_stiffness_) return;
    plant::AntennaPlant with_locked_motor = problem.plant;
    with_locked_motor.drive.viscous_friction = locking_friction;
    add(motor_locked_, "locked motor", with_locked_motor);
  }

  const SampledSetting& nominal() const { return settings_.front(); }
  const SampledLoopGoals& goals() const { return goals_; }
  const plant::ShapingFilter& filter() const { return filter_; }

  SampledDesign evaluate(plant::StateSpace controller) const {
    SampledDesign design;
    const Eigen::ArrayXXcd response =
        SampledSetting::controller_response(controller, nominal().frequency());
    std::vector<SampledResult> results(settings_.size());
    numerics::for_each_index(results.size(), threads_, [&](std::size_t i) {
      const SampledSetting& setting = settings_[i];
      const SampledEvaluation found = setting.evaluate(controller);
      results[i] = {setting.name(),
                    found.spectral_radius,
                    found.boresight_rms / ratio_,
                    found.wind_rms / ratio_,
                    found.noise_rms / ratio_,
                    found.control_effort,
                    setting.highest_peak(response)};
    });
    design.controller = std::move(controller);
    design.nominal = results.front();
    design.members.assign(results.begin() + 1, results.end());
    design.stable_members = static_cast<int>(
        std::ranges::count_if(design.members, [](const auto& one) { return one.stable(); }));
    const bool all = design.nominal.stable() && !design.members.empty() &&
                     design.stable_members == static_cast<int>(design.members.size());
    design.worst_rms =
        all ? std::ranges::max(results, {}, &SampledResult::boresight_rms).boresight_rms : nothing;
    return design;
  }

  std::optional<LimitedLqg> limited(const LqgSearchResult& found) const {
    if (!found.found) return std::nullopt;
    return LimitedLqg{found.weights, evaluate(found.controller), found.full_order};
  }
  std::optional<LimitedLqg> margin_limited() const {
    return limited(search_limited_lqg(nominal(), goals_));
  }
  std::optional<LimitedLqg> robustified() const {
    if (settings_.size() == 1) return std::nullopt;
    return limited(search_robust_lqg(nominal(), constraints()));
  }
  // Of limit.robustified where nothing else is given to start from.
  void refine(PointingLimit& limit) const {
    if (settings_.size() == 1) return;
    try {
      std::optional<RefinementResult> found;
      if (start_) {
        const auto start =
            with_idle_pairs(sampled(start_->controller), further_pairs(nominal().plant()),
                            damping_of_further_pairs);
        RefinementOptions options;
        options.steps = steps_from_loops;
        options.poles = pole_bounds;
        options.violations = violations_;
        // Conditions at rest are left out before corners: simulation shows what that costs, nothing
        // tests corners. Without them another step may have no violations.
        for (const auto corners : with_and_without(corners_)) {
          for (const AtRest& at_rest : conditions_at_rest()) {
            if (found && is_settled(*found)) break;
            auto next = refined(start, corners, at_rest, options);
            if (!next || (found && !is_better(*next, *found))) continue;
            found = std::move(next);
            limit.refined_from = start_->name;
          }
          if (found && found->feasible) break;
        }
      }
      if (!found && limit.robustified) {
        found = refine_controller(limit.robustified->design.controller, constraints());
        limit.refined_from = "robust LQG";
      }
      if (found && found->feasible) limit.refined = evaluate(std::move(found->controller));
    } catch (const NumericalFailure&) {
      limit.refined.reset();  // of poles that do not part
    }
    if (!limit.refined) limit.refined_from.clear();
  }
  plant::StateSpace sampled(const control::Controller& controller) const {
    return control::sampled_loop(nominal().problem().plant, controller,
                                 nominal().problem().sample_time)
        .controller;
  }

  // The command weight at which the LQG that charges all of the command has the effort allowed:
  // next to the one sought.
  double similar_weight() const {
    control::SampledLqgProblem problem = nominal().sampled();
    const control::StateEstimator estimator = control::state_estimator(problem);
    const double own = problem.r(0, 0);
    const auto excess = [&](double log_weight) {
      problem.r(0, 0) = own + std::exp(log_weight);
      const auto controller =
          control::lqg_controller(problem, control::lq_regulator(problem), estimator);
      return std::log(nominal().control_effort(controller) / goals_.control_effort);
    };
    problem.r(0, 0) = own + 1.0;
    const double rms = nominal().boresight_rms(
        control::lqg_controller(problem, control::lq_regulator(problem), estimator));
    // Effort falls with some -0.4th power of the weight.
    double place = 2.0 * std::log(rms / goals_.control_effort), slope = -0.4;
    double value = excess(place);
    for (int i = 0; i < 8 && std::abs(value) > 0.01; ++i) {
      const double next = place + std::clamp(-value / slope, -4.0, 4.0);
      const double at_next = excess(next);
      const double secant = (at_next - value) / (next - place);
      if (secant < -0.05) slope = secant;
      place = next;
      value = at_next;
    }
    return std::exp(place);
  }

  // Points about the weight for the effort allowed, and those on the way to it.
  void bound(PointingLimit& limit) const {
    const double weight = similar_weight();
    control::LqgProblem problem = nominal().problem();
    // So little that the bound loses some 1e-5 of the rms by it.
    problem.command_weight["valve_command"] = 1e-4 * weight;
    const control::SampledLqgProblem sampled = control::sampled_problem(problem);
    const control::LqgDesign design = control::lqg(problem);
    const auto at = [&](double w) {
      auto one = control::noise_effort_lqg(problem, sampled, design, w);
      limit.bound.points.push_back({w / (ratio_ * ratio_), one.cost / (ratio_ * ratio_)});
      return one;
    };
    for (const double factor : {0.25, 0.5, 2.0, 4.0, 8.0, 16.0}) at(factor * weight);
    // Where the effort is just what is allowed the bound is reached: by secants, the effort falling
    // with some -0.43rd power of the weight.
    double log_weight = std::log(weight), slope = -0.43;
    control::NoiseEffortDesign best = at(weight);
    double excess = std::log(nominal().control_effort(best.controller) / goals_.control_effort);
    for (int i = 0; i < 5 && std::abs(excess) > 1e-6; ++i) {
      const double step = std::clamp(-excess / slope, -1.0, 1.0);
      best = at(std::exp(log_weight + step));
      const double next =
          std::log(nominal().control_effort(best.controller) / goals_.control_effort);
      const double secant = (next - excess) / step;
      if (secant < -0.05) slope = secant;
      log_weight += step;
      excess = next;
    }
    limit.unconstrained = evaluate(std::move(best.controller));
    std::ranges::sort(limit.bound.points, {}, &EffortBound::Point::weight);
    limit.min_rms = limit.bound.min_rms(goals_.control_effort);
  }

  // The cost with next to no charge for the command, until less changes it by less than 1 %.
  double full_information_rms() const {
    control::SampledLqgProblem problem = nominal().sampled();
    const double own = problem.r(0, 0);
    const auto cost = [&](double weight) {
      problem.r(0, 0) = own + weight;
      return problem.unavoidable_cost + control::lq_regulator(problem)
                                            .cost_to_go.cwiseProduct(problem.process_covariance)
                                            .sum();
    };
    double weight = similar_weight(), last = cost(weight);
    for (int i = 0; i < 12; ++i) {
      weight *= 1e-2;
      double next = last;
      try {
        next = cost(weight);
      } catch (const NumericalFailure&) {
        break;  // as little as can be solved
      }
      const bool settled = next > 0.98 * last;
      last = std::min(next, last);
      if (settled) break;
    }
    return std::sqrt(last) / ratio_;
  }

 private:
  // Against limit cycles at an edge of the encoder: its plants, and a limit of the gain on a
  // locked motor.
  struct AtRest {
    std::span<const SampledSetting> edges;
    std::optional<double> breakaway_stiffness;
  };
  // From all conditions to none.
  std::vector<AtRest> conditions_at_rest() const {
    std::vector<AtRest> result;
    if (!at_edges_.empty()) result.push_back({at_edges_, breakaway_stiffness_});
    if (breakaway_stiffness_) result.push_back({{}, breakaway_stiffness_});
    result.push_back({});
    return result;
  }
  // None where the start is unstable on one of the plants. The gain on a locked motor is limited to
  // less where that one is not settled.
  std::optional<RefinementResult> refined(const plant::StateSpace& start,
                                          std::span<const SampledSetting> corners,
                                          const AtRest& at_rest,
                                          const RefinementOptions& options) const {
    std::optional<RefinementResult> best;
    for (const double gain : locked_motor_gains) {
      SampledLoopGoals goals = refined_goals_;
      if (at_rest.breakaway_stiffness) {
        goals.locked_motor_gain = gain * *at_rest.breakaway_stiffness;
      }
      const RobustConstraints constraints(
          {.plants = settings_,
           .at_standstill = std::span(at_standstill_).first(stated_slopes_),
           .at_edges = at_rest.edges,
           .corners = corners,
           .motor_locked = motor_locked_},
          goals, threads_);
      if (!constraints.stable(start)) return std::nullopt;
      RefinementResult next = refine_controller(start, constraints, options);
      const bool done = !goals.locked_motor_gain || is_settled(next);
      if (!best || is_better(next, *best)) best = std::move(next);
      if (done) break;
    }
    return best;
  }
  RobustConstraints constraints() const {
    return {{.plants = settings_, .at_standstill = at_standstill_}, goals_, threads_};
  }

  unsigned threads_;
  std::optional<DescribedController> start_;
  CountViolations violations_;
  double ratio_;
  SampledLoopGoals goals_, refined_goals_;
  plant::ShapingFilter filter_;
  std::vector<SampledSetting> settings_;  // nominal, then the members
  std::vector<SampledSetting> at_standstill_;
  std::size_t stated_slopes_ = 0;  // of these, the first: the constraint's own
  std::vector<SampledSetting> at_edges_, corners_;
  std::vector<SampledSetting> motor_locked_;  // by friction: at most one
  std::optional<double> breakaway_stiffness_;
};

ControllerAgainstLimit against(const DescribedController& named, const Study& study,
                               const PointingLimit& limit) {
  ControllerAgainstLimit result;
  result.name = named.name;
  result.design = study.evaluate(study.sampled(named.controller));
  const SampledResult& nominal = result.design.nominal;
  if (!nominal.stable()) return result;
  result.min_rms = limit.bound.min_rms(nominal.control_effort);
  const auto ratio = [](double mine, double other) {
    return other > 0.0 && std::isfinite(mine / other) ? std::optional(mine / other) : std::nullopt;
  };
  result.to_min = ratio(nominal.boresight_rms, result.min_rms);
  result.to_flexure = ratio(nominal.boresight_rms, limit.flexure_rms);
  result.to_full_information = ratio(nominal.boresight_rms, limit.full_information_rms);
  if (limit.margin_limited) {
    result.to_margin_limited =
        ratio(nominal.boresight_rms, limit.margin_limited->design.nominal.boresight_rms);
  }
  if (limit.robustified) {
    const SampledDesign& other = limit.robustified->design;
    result.to_robustified = ratio(nominal.boresight_rms, other.nominal.boresight_rms);
    result.worst_to_robustified = ratio(result.design.worst_rms, other.worst_rms);
  }
  return result;
}

}  // namespace

double EffortBound::min_rms(double control_effort) const {
  double best = 0.0;
  for (const Point& point : points) {
    best = std::max(best, point.cost - point.weight * control_effort * control_effort);
  }
  return std::sqrt(best);
}

double flexure_rms(const TrackingProblem& problem) {
  const control::LoopEvaluator evaluator = make_evaluator(problem);
  const Eigen::ArrayXd& frequency = evaluator.response().frequency;
  const auto structure = plant::structure_response(problem.plant.structure, frequency);
  return std::sqrt((evaluator.integration_weight() * structure.boresight_per_wind.abs2() *
                    motor_wind_spectrum(problem, frequency))
                       .sum()) /
         problem.gear_ratio;
}

PointingLimit pointing_limit(const TrackingProblem& problem, const Constraints& goals,
                             const std::vector<EnsembleMember>& members,
                             const std::vector<DescribedController>& controllers,
                             const PointingLimitOptions& options) {
  if (!(options.sample_time > 0.0) || !std::isfinite(options.sample_time)) {
    throw InvalidInput(fmt::format("pointing_limit: expected a sample time above 0, found {} s",
                                   options.sample_time));
  }
  for (const DescribedController& named : controllers) control::validate(named.controller);
  const Study study(problem, goals, members, options);
  PointingLimit limit;
  limit.sample_time = limit.computation_delay = options.sample_time;
  limit.effort_limit = study.goals().control_effort;
  limit.peak_limit = study.goals().sensitivity_peak;
  limit.wind_filter_log_error = study.filter().worst_log_error;
  study.bound(limit);
  limit.margin_limited = study.margin_limited();
  limit.robustified = study.robustified();
  study.refine(limit);
  limit.full_information_rms = study.full_information_rms();
  limit.flexure_rms = flexure_rms(problem);
  for (const DescribedController& named : controllers)
    limit.controllers.push_back(against(named, study, limit));
  return limit;
}

}  // namespace boresight::design
