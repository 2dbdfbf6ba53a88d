#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/commissioning/commissioning_path.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

using control::Controller;
using control::LoopPath;

constexpr double infinity = std::numeric_limits<double>::infinity();
// How far the loop gain is raised in search of the peak at which to give up.
constexpr double highest_raise = 8.0;
constexpr double largest_detuning = 64.0;
// The Bode plot of a stage reaches so far below and above the crossover.
constexpr double bode_reach = 30.0;
constexpr Eigen::Index bode_points = 60;

void check(const std::vector<EnsembleMember>& members, const CommissioningOptions& options) {
  if (members.size() < 3) {
    throw InvalidInput(fmt::format(
        "plan_commissioning: expected at least 3 ensemble members, found {}", members.size()));
  }
  const bool in_order = options.largest_step > 1.0 && options.largest_step <= 10.0 &&
                        options.sensitivity_limit > 1.0 &&
                        options.abort_peak > options.sensitivity_limit &&
                        options.abort_peak < infinity && options.overshoot_allowance >= 0.0 &&
                        options.rms_allowance >= 1.0;
  if (!in_order) {
    throw InvalidInput(fmt::format(
        "plan_commissioning: expected a largest step above 1, at most 10, 1 < limit of S < peak to "
        "give up at, and allowances of at least 0 for overshoot and 1 for rms, found {}, {} and "
        "{}, "
        "{} and {}",
        options.largest_step, options.sensitivity_limit, options.abort_peak,
        options.overshoot_allowance, options.rms_allowance));
  }
  const bool within = options.confidence > 0.0 && options.confidence < 1.0;
  if (!within) {
    throw InvalidInput(fmt::format(
        "plan_commissioning: expected a confidence within (0, 1), found {}", options.confidence));
  }
}

// The gain by which a stage's loop is raised as a whole.
std::size_t loop_gain_index(const StageController& stage) {
  const LoopPath path = stage.position_open ? LoopPath::rate : LoopPath::position;
  std::size_t first = 0;
  for (const auto& block : stage.controller.structure.blocks()) {
    if (block.path == path && block.kind == control::BlockKind::gain) return first;
    first += block.gains.size();
  }
  return 0;
}

StageController raised(StageController stage, double factor) {
  if (stage.controller.structure.state_space() != nullptr) {
    stage.controller = control::with_output_times(factor, stage.controller);
    stage.output_factor *= factor;
    return stage;
  }
  stage.controller.gains[loop_gain_index(stage)] *= factor;
  return stage;
}

// All plants, the problem's own first.
class Plants {
 public:
  Plants(const TrackingProblem& problem, const std::vector<EnsembleMember>& members,
         const CommandedMove& move, const CommissioningOptions& options)
      : options_(options) {
    const WindTable wind(problem);
    names_.emplace_back("the problem's own");
    observers_.emplace_back(problem, problem.plant, wind, move);
    for (const auto& member : members) {
      names_.push_back(member.name);
      observers_.emplace_back(problem, member.plant, wind, move);
    }
  }

  // The largest over the plants, and whose.
  double worst_peak(const StageController& stage, std::size_t& worst) {
    std::vector<double> peaks(observers_.size());
    each([&](std::size_t i) { peaks[i] = observers_[i].peak(stage); });
    const auto largest = std::ranges::max_element(peaks);
    worst = static_cast<std::size_t>(largest - peaks.begin());
    return *largest;
  }
  double worst_peak(const StageController& stage) {
    std::size_t worst = 0;
    return worst_peak(stage, worst);
  }

  CommissioningStage look_at(StageKind kind, const StageController& controller) {
    if (options_.stop && options_.stop()) throw Interrupted("interrupted by the user");
    std::vector<StageObservation> seen(observers_.size());
    each([&](std::size_t i) { seen[i] = observers_[i].observe(controller); });
    CommissioningStage stage;
    stage.kind = kind;
    stage.controller = controller;
    expect(seen, stage.expected);
    if (stage.expected.all_stable() && seen.front().crossover > 0.0)
      stage.bode = bode(controller, seen.front().crossover);
    limit(stage);
    return stage;
  }

 private:
  void each(const std::function<void(std::size_t)>& work) {
    numerics::for_each_index(observers_.size(), options_.threads, work);
  }

  PlantBand band(const std::vector<StageObservation>& seen,
                 const std::function<double(const StageObservation&)>& quantity) const {
    std::vector<double> values;
    for (const auto& one : seen) values.push_back(quantity(one));
    return plant_band(values.front(), values, options_.confidence);
  }

  void expect(const std::vector<StageObservation>& seen, StageExpectation& expected) const {
    using Seen = StageObservation;
    expected.plants = seen.size();
    expected.stable = static_cast<std::size_t>(
        std::ranges::count_if(seen, [](const Seen& one) { return one.stable; }));
    expected.peak = band(seen, [](const Seen& s) { return s.peak; });
    expected.crossover = band(seen, [](const Seen& s) { return s.crossover; });
    expected.rise_time = band(seen, [](const Seen& s) { return s.rise_time; });
    // Of the peak, 1 and the overshoot: logarithms of overshoots near 0 would scatter wildly.
    expected.overshoot = band(seen, [](const Seen& s) { return 1.0 + s.overshoot; });
    for (auto* end :
         {&expected.overshoot.nominal, &expected.overshoot.minimum, &expected.overshoot.largest,
          &expected.overshoot.lower, &expected.overshoot.upper}) {
      *end = *end < 1.0 ? 0.0 : *end - 1.0;
    }
    expected.settling_time = band(seen, [](const Seen& s) { return s.settling_time; });
    expected.largest_demand = band(seen, [](const Seen& s) { return s.largest_demand; });
    expected.largest_torque = band(seen, [](const Seen& s) { return s.largest_torque; });
    expected.calm_encoder = band(seen, [](const Seen& s) { return s.calm.encoder_error; });
    expected.calm_tachometer = band(seen, [](const Seen& s) { return s.calm.tachometer; });
    expected.calm_torque = band(seen, [](const Seen& s) { return s.calm.torque; });
    expected.calm_valve = band(seen, [](const Seen& s) { return s.calm.valve_command; });
    expected.windy_encoder = band(seen, [](const Seen& s) { return s.windy.encoder_error; });
    expected.windy_tachometer = band(seen, [](const Seen& s) { return s.windy.tachometer; });
    expected.windy_torque = band(seen, [](const Seen& s) { return s.windy.torque; });
    expected.windy_valve = band(seen, [](const Seen& s) { return s.windy.valve_command; });
    expected.boresight_rms = band(seen, [](const Seen& s) { return s.boresight_rms; });
    expected.move_error = band(seen, [](const Seen& s) { return s.move_error; });
    expected.valve_per_rate = band(seen, [](const Seen& s) { return s.valve_per_rate; });
    expected.oil_stiffness = band(seen, [](const Seen& s) { return s.oil_stiffness; });
  }

  // The closed loop about its crossover, as far as the sampled command shows it.
  StageBode bode(const StageController& controller, double crossover) {
    const double highest =
        std::min(bode_reach * crossover, control::nyquist_frequency(controller.controller));
    StageBode result;
    const Eigen::ArrayXd frequency =
        Eigen::ArrayXd::LinSpaced(bode_points, std::log(crossover / bode_reach), std::log(highest))
            .exp();
    std::vector<Eigen::ArrayXcd> responses(observers_.size());
    each([&](std::size_t i) { responses[i] = observers_[i].response(controller, frequency); });
    std::vector<double> before(observers_.size(), 0.0);
    for (Eigen::Index k = 0; k < frequency.size(); ++k) {
      std::vector<double> gains, phases;
      for (std::size_t i = 0; i < responses.size(); ++i) {
        gains.push_back(std::abs(responses[i][k]));
        // Without jumps of a turn along the frequencies.
        before[i] += std::remainder(std::arg(responses[i][k]) - before[i], two_pi);
        phases.push_back(before[i]);
      }
      result.frequency.push_back(frequency[k]);
      result.gain.push_back(plant_band(gains.front(), gains, options_.confidence));
      result.phase.push_back(signed_plant_band(phases.front(), phases, options_.confidence));
    }
    return result;
  }

  // Where the band ends, with what is allowed for measuring; or earlier where the worst plant is at
  // the peak to give up at, if that is beyond the band by half of what is allowed.
  static double earlier(const PlantBand& expected, double allowed, double at_peak) {
    return at_peak > 0.5 * (expected.upper + allowed) ? std::min(allowed, at_peak) : allowed;
  }

  void limit(CommissioningStage& stage) {
    AbortLimits& abort = stage.abort;
    std::size_t worst = 0;
    const double peak = worst_peak(stage.controller, worst);
    abort.worst_plant = names_[worst];
    abort.overshoot = stage.expected.overshoot.upper + options_.overshoot_allowance;
    abort.calm_valve_rms = stage.expected.calm_valve.upper * options_.rms_allowance;
    abort.calm_encoder_rms = stage.expected.calm_encoder.upper * options_.rms_allowance;
    abort.gain_reserve = peak < options_.abort_peak ? infinity : 1.0;
    if (!(peak < options_.abort_peak) ||
        observers_[worst].peak(raised(stage.controller, highest_raise)) < options_.abort_peak) {
      return;
    }
    double low = 1.0;
    double high = highest_raise;
    for (int k = 0; k < 30 && high - low > 1e-4; ++k) {
      const double middle = std::sqrt(low * high);
      (observers_[worst].peak(raised(stage.controller, middle)) < options_.abort_peak ? low
                                                                                      : high) =
          middle;
    }
    abort.gain_reserve = low;
    const auto there = observers_[worst].observe(raised(stage.controller, low));
    abort.overshoot = earlier(stage.expected.overshoot, abort.overshoot, there.overshoot);
    abort.calm_valve_rms =
        earlier(stage.expected.calm_valve, abort.calm_valve_rms, there.calm.valve_command);
    if (!stage.controller.position_open) {
      abort.calm_encoder_rms =
          earlier(stage.expected.calm_encoder, abort.calm_encoder_rms, there.calm.encoder_error);
    }
  }

  const CommissioningOptions& options_;
  std::vector<std::string> names_;
  std::vector<StageObserver> observers_;
};

void number_steps(std::vector<CommissioningStage>& stages) {
  for (auto& stage : stages) {
    const auto same = [&](const CommissioningStage& other) { return other.kind == stage.kind; };
    stage.steps = static_cast<int>(std::ranges::count_if(stages, same));
    stage.step = static_cast<int>(std::count_if(stages.data(), &stage, same)) + 1;
  }
}

bool all_stable(const CommissioningStage& stage) {
  return stage.expected.stable == stage.expected.plants;
}

// The controller in the target's structure that the antenna's own gains make; none where they make
// none or are not allowed.
std::optional<Controller> start_from(Plants& plants, const Controller& found,
                                     const Controller& target, double limit,
                                     CommissioningPlan& plan) {
  auto start = controller_within(found, target);
  if (!start) {
    plan.remarks.emplace_back(
        "The controller found has parts that the controller chosen has not: no path of gains "
        "leads from one to "
        "the other. The plan starts afresh, from gains of the controller chosen.");
  } else if (plants.worst_peak({*start, true, false}) > limit) {
    plan.remarks.push_back(
        fmt::format("The rate loop as found has an Ms above {:g} on an ensemble member. "
                    "The plan starts afresh, from gains of the controller chosen.",
                    limit));
    start.reset();
  }
  return start;
}

// The gains the plan starts from where none can be started from.
Controller assumed_start(Plants& plants, const Controller& target, double limit,
                         CommissioningPlan& plan) {
  const Controller plain = without_torque_paths(target);
  for (double factor = 2.0; factor <= largest_detuning; factor *= 2.0) {
    // A controller whose position loop does the rate loop's work must keep its rate loop: slower,
    // its integral would reach into the position loop.
    for (const double rate_factor : {factor, 1.0}) {
      Controller start = detuned(plain, rate_factor, factor);
      if (plants.worst_peak({start, true, false}) <= limit &&
          plants.worst_peak({start, false, false}) <= limit) {
        plan.detuning = factor;
        plan.rate_detuned = rate_factor > 1.0;
        return start;
      }
    }
  }
  throw InfeasibleRequirement(fmt::format(
      "the gains of the antenna as found are not known, and the controller chosen, "
      "without pressure feedback, has no Ms below {:g} on every plant even with its gains "
      "divided by {:g}: give the gains found",
      limit, largest_detuning));
}

}  // namespace

std::string_view to_string(StageKind kind) {
  static constexpr std::array names{"as found",   "rate loop", "pressure feedback", "position loop",
                                    "compliance", "output",    "feedforward"};
  return names.at(static_cast<std::size_t>(kind));
}

double CommissioningPlan::largest_peak() const {
  double largest = 0.0;
  for (const CommissioningStage& stage : stages) {
    if (stage.kind == StageKind::as_found) continue;
    largest = std::max(largest, stage.expected.peak.largest);
  }
  return largest;
}

CommissioningPlan plan_commissioning(const TrackingProblem& problem,
                                     const std::vector<EnsembleMember>& members,
                                     const std::optional<control::Controller>& found,
                                     const control::Controller& target, const CommandedMove& move,
                                     const CommissioningOptions& options) {
  check(members, options);
  control::validate(target);
  Plants plants(problem, members, move, options);
  CommissioningPlan plan;
  const double own =
      std::max(plants.worst_peak({target, true, false}), plants.worst_peak({target, false, false}));
  if (!std::isfinite(own)) {
    throw InfeasibleRequirement(
        "the controller chosen is unstable on an ensemble member: "
        "choose a controller that is tuned robustly");
  }
  if (own > options.sensitivity_limit) {
    plan.remarks.push_back(
        fmt::format("The controller chosen has itself an Ms of {:.2f} on a plant, above the {:g} "
                    "meant to be kept "
                    "on the way: its own is kept instead.",
                    own, options.sensitivity_limit));
  }
  const double limit = std::max(options.sensitivity_limit, own * (1.0 + 1e-9));

  const bool state_space = target.structure.state_space() != nullptr;
  std::optional<Controller> start;
  if (found) {
    control::validate(*found);
    plan.stages.push_back(plants.look_at(StageKind::as_found, {*found, false, false}));
    if (!state_space) start = start_from(plants, *found, target, limit, plan);
  }
  if (!state_space && !start) start = assumed_start(plants, target, limit, plan);

  const auto allowed = [&](const StageController& stage) {
    if (options.stop && options.stop()) throw Interrupted("interrupted by the user");
    return plants.worst_peak(stage) <= limit;
  };
  std::string why_not;
  std::optional<std::vector<PathStage>> path;
  plan.largest_step = options.largest_step;
  for (int attempt = 0; attempt < 3 && !path; ++attempt) {
    if (attempt > 0) plan.largest_step = std::sqrt(plan.largest_step);
    path = start ? commissioning_path(*start, target, plan.largest_step, allowed, why_not)
                 : output_path(target, plan.largest_step, allowed, why_not);
  }
  if (!path) {
    throw InfeasibleRequirement(fmt::format(
        "no path of {} with Ms below {:g} on every plant was found, "
        "with steps down to a factor of {:.3g}: {}",
        state_space ? "factors on the output" : "gains", limit, plan.largest_step, why_not));
  }
  if (state_space) {
    plan.remarks.push_back(fmt::format(
        "The controller is a state space: it replaces the gains as a whole, at rest, with {:.3g} "
        "of its output, which the stages raise. It has no anti-windup: keep the valve off its "
        "limits.",
        path->front().controller.output_factor));
  }
  for (const auto& stage : *path) {
    plan.stages.push_back(plants.look_at(stage.kind, stage.controller));
    if (options.progress) options.progress(plan.stages.size(), path->size());
    if (!all_stable(plan.stages.back())) {
      throw NumericalFailure(
          fmt::format("a stage of the {} is unstable on {} of {} plants by its "
                      "eigenvalues, though not by its frequency response",
                      to_string(stage.kind),
                      plan.stages.back().expected.plants - plan.stages.back().expected.stable,
                      plan.stages.back().expected.plants));
    }
  }
  number_steps(plan.stages);
  return plan;
}

}  // namespace boresight::design
