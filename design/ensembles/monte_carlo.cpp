#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/design/tuning/tuner.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kinds = 8;
constexpr std::size_t breaks = control::loop_breaks.size();

// A goal's bit: kind by kind, break by break where the kind has one; those not asked for stay 0.
std::size_t bit_of(GoalKind kind, std::optional<control::LoopBreak> loop_break) {
  return static_cast<std::size_t>(kind) * breaks +
         (loop_break ? static_cast<std::size_t>(*loop_break) : 0);
}

struct NamedGoal {
  GoalKind kind;
  std::optional<control::LoopBreak> loop_break;
};

std::vector<NamedGoal> asked_for(const Constraints& goals) {
  std::vector<NamedGoal> asked;
  for (const auto cut : control::loop_breaks) asked.push_back({GoalKind::sensitivity_peak, cut});
  asked.push_back({GoalKind::control_effort, std::nullopt});
  for (std::size_t b = 0; b < breaks; ++b) {
    if (goals.gain_margin.at(b)) {
      asked.push_back({GoalKind::gain_margin, control::loop_breaks.at(b)});
    }
  }
  for (std::size_t b = 0; b < breaks; ++b) {
    if (goals.phase_margin.at(b)) {
      asked.push_back({GoalKind::phase_margin, control::loop_breaks.at(b)});
    }
  }
  if (goals.bandwidth) {
    asked.push_back({GoalKind::bandwidth, control::LoopBreak::position_loop});
  }
  if (goals.gust_demand) asked.push_back({GoalKind::gust_demand, std::nullopt});
  if (goals.gust_torque) asked.push_back({GoalKind::gust_torque, std::nullopt});
  if (goals.static_encoder_error) {
    asked.push_back({GoalKind::static_encoder_error, std::nullopt});
  }
  return asked;
}

static_assert(kinds * breaks <= 32);

}  // namespace

std::vector<std::string> goal_names(const Constraints& goals) {
  std::vector<std::string> names;
  for (const auto& [kind, loop_break] : asked_for(goals)) {
    NormalisedConstraint ratio;
    ratio.kind = kind;
    ratio.loop_break = loop_break;
    names.push_back(describe(ratio));
  }
  return names;
}

std::vector<bool> goals_applied(const Constraints& goals, const control::Controller& controller) {
  std::vector<bool> applied;
  for (const auto& [kind, loop_break] : asked_for(goals)) {
    // The bandwidth of a state space is that of its loop through the encoder.
    applied.push_back(!loop_break || kind == GoalKind::bandwidth ||
                      control::has_break(controller, *loop_break));
  }
  return applied;
}

MonteCarloEvaluator::MonteCarloEvaluator(const MonteCarlo& study)
    : study_(study), fixed_gain_(study.problem, study.controller, study.goals, study.fixed_gain) {
  validate(study.goals);
  if (study.confirm_every < 1) {
    throw InvalidInput("MonteCarlo: expected confirm_every of 1 or more, found 0");
  }
  if (study.retune && study.controller.gains.empty()) {
    throw InvalidInput(
        "MonteCarlo: expected a controller with gains to retune, found a state space");
  }
  mean_torque_ = plant::mean_wind_torque(study.problem.wind.site, study.problem.wind.mean_speed) /
                 study.problem.gear_ratio;
}

PlantOutcome MonteCarloEvaluator::evaluate(std::uint64_t index) {
  try {
    return evaluate(study_.plant(index), index % study_.confirm_every == 0);
  } catch (const NumericalFailure& failure) {
    throw NumericalFailure(fmt::format("plant {}: {}", index, failure.what()));
  }
}

PlantOutcome MonteCarloEvaluator::evaluate(const plant::AntennaPlant& plant, bool confirm_this) {
  const FixedGainValues values = fixed_gain_.evaluate(plant);
  PlantOutcome outcome;
  outcome.stability_basis =
      values.stable ? StabilityBasis::stable_by_encirclements : StabilityBasis::unstable;
  // The values come first: confirming looks at the plant again.
  set_goals(plant, values, outcome);
  if (confirm_this || fixed_gain_.near_the_axis(values)) confirm(plant, outcome);
  const double ratio = study_.problem.gear_ratio;
  outcome.boresight_rms = std::sqrt(values.wind_variance + values.noise_variance) / ratio;
  outcome.climate_rms = study_.problem.climate.empty()
                            ? nan
                            : std::sqrt(values.climate_variance + values.noise_variance) / ratio;
  outcome.control_effort = std::sqrt(values.effort_variance);
  outcome.sensitivity_peaks = values.sensitivity_peaks;
  outcome.retuned_rms = study_.retune ? retuned_rms(plant) : nan;
  if (!outcome.stable()) {
    outcome.boresight_rms = outcome.climate_rms = outcome.control_effort = nan;
    outcome.sensitivity_peaks.fill(nan);
    outcome.worst_constraint = infinity;
    outcome.violated_constraints = 0;
  }
  return outcome;
}

void MonteCarloEvaluator::confirm(const plant::AntennaPlant& plant, PlantOutcome& outcome) {
  const auto verdict = fixed_gain_.confirm(plant);
  outcome.confirmed = 1;
  const bool encirclements = outcome.stability_basis == StabilityBasis::stable_by_encirclements;
  const bool poles = verdict.rate_loop_abscissa < 0.0 && verdict.closed_loop_abscissa < 0.0;
  outcome.contradicted = encirclements != poles ? 1 : 0;
  if (verdict.dead_time_residue >= 1.0) {
    outcome.stability_basis = StabilityBasis::undecided;
  } else {
    outcome.stability_basis =
        poles ? StabilityBasis::stable_by_eigenvalues : StabilityBasis::unstable;
  }
}

void MonteCarloEvaluator::add_margins(const plant::AntennaPlant& plant) {
  append_margin_ratios(control::make_channels(plant, fixed_gain_.frequencies()),
                       study_.problem.delay, study_.controller, study_.goals, ratios_);
}

void MonteCarloEvaluator::set_goals(const plant::AntennaPlant& plant, const FixedGainValues& values,
                                    PlantOutcome& outcome) {
  const Constraints& goals = study_.goals;
  ratios_.clear();
  const auto add = [&](GoalKind kind, std::optional<control::LoopBreak> loop_break, double ratio) {
    NormalisedConstraint& goal = ratios_.emplace_back();
    goal.kind = kind;
    goal.loop_break = loop_break;
    goal.ratio = ratio;
  };
  for (std::size_t b = 0; b < breaks; ++b) {
    if (!control::has_break(study_.controller, control::loop_breaks.at(b))) continue;
    add(GoalKind::sensitivity_peak, control::loop_breaks.at(b),
        values.sensitivity_peaks.at(b) / goals.sensitivity_peak.at(b));
  }
  add(GoalKind::control_effort, std::nullopt,
      std::sqrt(values.effort_variance) / goals.control_effort);
  const double leaking = plant.drive.leakage_rate / plant.drive.oil_stiffness * mean_torque_;
  if (goals.gust_demand) {
    add(GoalKind::gust_demand, std::nullopt,
        (leaking + goals.crest_factor * std::sqrt(values.wind_demand_variance)) /
            *goals.gust_demand);
  }
  if (goals.gust_torque) {
    add(GoalKind::gust_torque, std::nullopt,
        (mean_torque_ + goals.crest_factor * std::sqrt(values.wind_torque_variance)) /
            *goals.gust_torque);
  }
  if (goals.static_encoder_error) {
    ratios_.push_back(static_error_constraint(study_.controller, leaking, study_.problem.gear_ratio,
                                              *goals.static_encoder_error));
  }
  if (goals.ask_for_margins()) add_margins(plant);
  // A controller tuned to rest on a limit may be above it by rounding on the plant it was tuned
  // for.
  constexpr double rounding = 1e-4;
  std::uint32_t broken = 0;
  for (const auto& goal : ratios_) {
    outcome.worst_constraint = std::max(outcome.worst_constraint, goal.ratio);
    if (!(goal.ratio <= 1.0 + rounding)) broken |= 1U << bit_of(goal.kind, goal.loop_break);
  }
  // In the order of goal_names().
  std::uint32_t place = 0;
  for (const auto& [kind, loop_break] : asked_for(goals)) {
    outcome.violated_constraints |= ((broken >> bit_of(kind, loop_break)) & 1U) << place++;
  }
}

double MonteCarloEvaluator::retuned_rms(const plant::AntennaPlant& plant) const {
  TrackingProblem problem = study_.problem;
  problem.plant = plant;
  if (!study_.retune_over_climate) problem.climate.clear();
  TuningOptions options;
  options.starts = 0;
  options.warm_starts = {study_.controller.gains};
  const TuningResult tuned = tune(problem, study_.controller.structure, study_.goals, options);
  if (tuned.status != TuningStatus::optimal) return nan;
  if (!study_.retune_over_climate) {
    return std::sqrt(tuned.evaluation.boresight_variance()) / problem.gear_ratio;
  }
  problem.climate.clear();
  auto evaluator = make_adaptive_evaluator(problem, WindTable(problem));
  return std::sqrt(evaluator.evaluate(tuned.controller, false).boresight_variance()) /
         problem.gear_ratio;
}

MonteCarloRun::MonteCarloRun(const MonteCarlo& study) : study_(study), evaluator_(study) {
  if (study_.plants < 1) throw InvalidInput("MonteCarlo: expected 1 plant or more, found 0");
  if (!study_.plant) throw InvalidInput("MonteCarlo: expected plants, found no function of them");
  blocks_ = static_cast<std::size_t>((study_.plants + block_size - 1) / block_size);
  outcomes_.resize(study_.plants);
  whole_ = std::make_unique<std::atomic<bool>[]>(blocks_);
}

std::uint64_t MonteCarloRun::size_of(std::size_t block) const {
  const std::uint64_t first = static_cast<std::uint64_t>(block) * block_size;
  return std::min(block_size, study_.plants - first);
}

std::vector<std::size_t> MonteCarloRun::missing_blocks() const {
  std::vector<std::size_t> missing;
  for (std::size_t block = 0; block < blocks_; ++block) {
    if (!whole(block)) missing.push_back(block);
  }
  return missing;
}

std::uint64_t MonteCarloRun::plants_done() const {
  std::uint64_t done = 0;
  for (std::size_t block = 0; block < blocks_; ++block) done += whole(block) ? size_of(block) : 0;
  return done;
}

std::span<const PlantOutcome> MonteCarloRun::outcomes(std::size_t block) const {
  return {outcomes_.data() + block * block_size, static_cast<std::size_t>(size_of(block))};
}

void MonteCarloRun::put(std::size_t block, std::span<const PlantOutcome> outcomes) {
  if (block >= blocks_ || outcomes.size() != size_of(block)) {
    throw InvalidInput(
        fmt::format("MonteCarloRun::put: expected a block below {} and all of its "
                    "plants, found block {} and {}",
                    blocks_, block, outcomes.size()));
  }
  std::ranges::copy(outcomes, outcomes_.begin() + static_cast<std::ptrdiff_t>(block * block_size));
  whole_[block].store(true, std::memory_order_release);
}

void MonteCarloRun::work_on(const std::vector<std::size_t>& blocks, const Options& options) {
  constexpr auto watch_every = std::chrono::milliseconds(200);
  std::atomic<bool> stopped{false};
  const auto work_on_block = [&](std::size_t i) {
    // Worked on where no other thread writes, and put in place when whole.
    MonteCarloEvaluator evaluate = evaluator_;
    std::vector<PlantOutcome> outcomes;
    const std::uint64_t first = static_cast<std::uint64_t>(blocks[i]) * block_size;
    for (std::uint64_t k = 0; k < size_of(blocks[i]); ++k) {
      if (options.stop && options.stop()) stopped = true;
      if (stopped) return;
      outcomes.push_back(evaluate.evaluate(first + k));
    }
    put(blocks[i], outcomes);
  };
  auto working = std::async(std::launch::async, [&] {
    numerics::for_each_index(blocks.size(), options.threads, work_on_block);
  });
  try {
    while (working.wait_for(watch_every) != std::future_status::ready) {
      if (options.watch) options.watch();
    }
  } catch (...) {
    stopped = true;
    throw;
  }
  working.get();
  if (options.watch) options.watch();
}

}  // namespace boresight::design
