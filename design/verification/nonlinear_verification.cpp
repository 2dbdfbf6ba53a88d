#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/design/verification/linear_prediction.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int continuous = 16;  // times as many samples stand for a continuous loop

// What is kept of a run in wind.
struct WindRun {
  RunStatus status = RunStatus::complete;
  std::string message;
  double boresight_variance = 0.0;
  double encoder_variance = 0.0;
  double at_command_limit = 0.0;
  ErrorTrace trace;
};

double variance(const VectorXd& values) {
  return (values.array() - values.mean()).square().mean();
}

VectorXd about_mean(const VectorXd& values) {
  return values.array() - values.mean();
}

// The last `count` errors of a complete run, the boresight's about their mean.
ErrorTrace last_errors(const LoopRun& run, double interval, Index count) {
  if (run.status != RunStatus::complete) return {};
  return {interval, about_mean(run.boresight_error.tail(count)), run.encoder_error.tail(count)};
}

double fraction_at_limit(const SimulatedLoop& loop, const LoopRun& run) {
  const VectorXd command = plant::column(run.result, "valve_command");
  const double limit = loop.antenna.valve.stroke_limit * (1.0 - 1e-12);
  return static_cast<double>((command.array().abs() >= limit).count()) /
         static_cast<double>(command.size());
}

WindRun keep(const SimulatedLoop& loop, const LoopRun& run, Index settled) {
  WindRun kept;
  kept.status = run.status;
  kept.message = run.message;
  if (run.status != RunStatus::complete) return kept;
  const Index rest = run.boresight_error.size() - 1 - settled;
  kept.boresight_variance = variance(run.boresight_error.tail(rest));
  kept.encoder_variance = variance(run.encoder_error.tail(rest));
  kept.at_command_limit = fraction_at_limit(loop, run);
  return kept;
}

// One kind of run in wind over the seeds.
struct Pooled {
  RunStatus status = RunStatus::complete;
  std::string message;
  double boresight_rms = 0.0;
  double encoder_rms = 0.0;
  double at_command_limit = 0.0;
};

Pooled pool(const WindRun* runs, std::size_t count) {
  Pooled pooled;
  for (std::size_t i = 0; i < count; ++i) {
    const WindRun& run = runs[i];
    if (run.status > pooled.status) pooled.status = run.status;
    if (pooled.message.empty()) pooled.message = run.message;
    pooled.boresight_rms += run.boresight_variance;
    pooled.encoder_rms += run.encoder_variance;
    pooled.at_command_limit += run.at_command_limit / static_cast<double>(count);
  }
  const auto root_of_mean = [&](double sum) {
    return pooled.status == RunStatus::complete ? std::sqrt(sum / static_cast<double>(count)) : nan;
  };
  pooled.boresight_rms = root_of_mean(pooled.boresight_rms);
  pooled.encoder_rms = root_of_mean(pooled.encoder_rms);
  return pooled;
}

ReferenceTrajectory first_steps(const ReferenceTrajectory& course, Index steps) {
  const Index kept = std::min(steps, course.reference.size());
  return {course.interval, course.reference.head(kept), course.reference_rate.head(kept),
          course.reference_acceleration.head(kept), course.wind_torque.head(kept)};
}

// Runs in wind: every kind with every seed, the seeds of a kind in a row.
class WindStudy {
 public:
  WindStudy(const TrackingProblem& problem, const SimulatedLoop& loop,
            const NonlinearVerificationOptions& options)
      : problem_(problem), loop_(loop), options_(options) {
    const auto winds = options.winds ? options.winds : std::make_shared<SharedWinds>();
    const auto courses = winds->courses({problem, loop, options.tracking_rate * loop.gear_ratio,
                                         options.settling + options.wind_duration});
    for (const std::uint64_t seed : options.seeds) courses_.push_back(courses->course(seed));
    if (options.explain) {
      for (const Influence influence : influences) {
        if (has(loop, influence)) switched_.push_back(influence);
      }
    }
    const std::size_t kinds = options.explain ? first_switched + switched_.size() : 1;
    runs_.resize(kinds * options.seeds.size());
  }

  std::size_t jobs() const { return runs_.size(); }

  void run(std::size_t job) {
    const std::size_t kind = job / options_.seeds.size();
    const std::size_t seed = job % options_.seeds.size();
    const ReferenceTrajectory& course = courses_[seed];
    LoopRunOptions how;
    how.seed = options_.seeds[seed];
    if (kind >= first_switched) how.without = {switched_[kind - first_switched]};
    // A state space has no other form than its sampled one.
    const int finer = kind == continuous_kind && loop_.controller.structure.state_space() == nullptr
                          ? continuous
                          : 1;
    const LoopRun run = kind == linear_kind || kind == continuous_kind
                            ? run_linear_loop(loop_, course, finer, how)
                            : run_loop(loop_, course, how);
    const Index settled = whole_samples(options_.settling, loop_.sample_time);
    runs_[job] = keep(loop_, run, settled);
    if (kind != whole_kind || seed != 0) return;
    ErrorTrace& trace = runs_[job].trace;
    trace = last_errors(run, course.interval, course.reference.size() - 1 - settled);
    if (trace.encoder.size() > 0) trace.encoder = about_mean(trace.encoder);
  }

  const ErrorTrace& first_trace() const { return runs_.front().trace; }

  IntegratorAgreement compare_integrators() const {
    const ReferenceTrajectory& course = courses_.front();
    const Index steps =
        1 + whole_samples(options_.settling + options_.second_integrator_duration, course.interval);
    return integrator_agreement(loop_, first_steps(course, steps),
                                {.settling = options_.settling, .seed = options_.seeds.front()});
  }

  WindResult result() const {
    const auto kind = [&](std::size_t number) {
      return pool(&runs_[number * options_.seeds.size()], options_.seeds.size());
    };
    const Pooled whole = kind(whole_kind);
    WindResult result;
    result.status = whole.status;
    result.message = whole.message;
    result.boresight_rms = whole.boresight_rms;
    result.encoder_rms = whole.encoder_rms;
    result.at_command_limit = whole.at_command_limit;
    result.trace = first_trace();
    result.predicted_rms = predicted_rms(problem_, loop_.controller) / loop_.gear_ratio;
    result.static_error = static_boresight_error(problem_, loop_.controller);
    if (!options_.explain) {
      result.linear_rms = result.continuous_rms = result.realisation_error = result.sampling = nan;
      result.interaction = nan;
      return result;
    }
    result.linear_rms = kind(linear_kind).boresight_rms;
    result.continuous_rms = kind(continuous_kind).boresight_rms;
    result.realisation_error = result.continuous_rms - result.predicted_rms;
    result.sampling = result.linear_rms - result.continuous_rms;
    result.interaction = result.boresight_rms - result.linear_rms;
    for (std::size_t i = 0; i < switched_.size(); ++i) {
      const Pooled without = kind(first_switched + i);
      result.influences.push_back({switched_[i], without.status, without.boresight_rms,
                                   result.boresight_rms - without.boresight_rms});
      result.interaction -= result.influences.back().difference;
    }
    return result;
  }

 private:
  static constexpr std::size_t whole_kind = 0, linear_kind = 1, continuous_kind = 2,
                               first_switched = 3;

  const TrackingProblem& problem_;
  const SimulatedLoop& loop_;
  const NonlinearVerificationOptions& options_;
  std::vector<ReferenceTrajectory> courses_;
  std::vector<Influence> switched_;
  std::vector<WindRun> runs_;
};

// A slow triangle of the tracking rate.
struct ReversalTrajectory {
  ReferenceTrajectory reference;
  Index per_leg = 0;
  Index rest = 0;  // samples after the first reversals, which set the loop swinging; those repeat
};

ReversalTrajectory reversal_trajectory(const SimulatedLoop& loop,
                                       const NonlinearVerificationOptions& options) {
  const double gear = loop.gear_ratio;
  const double leg = options.reversal_leg;
  constexpr Index legs = 6, first_legs = 2;
  const double rate = options.tracking_rate * gear;
  const auto target = [&](double t) {
    const double into = t - options.settling;
    const auto turn = std::max<Index>(static_cast<Index>(std::floor(into / leg)), 0);
    const double since = into - leg * static_cast<double>(turn);
    const bool up = turn % 2 == 0;
    const double angle = up ? rate * since : rate * (leg - since);
    return control::CommandSample{angle, up ? rate : -rate, 0.0};
  };
  const Index settled = whole_samples(options.settling, loop.sample_time);
  const Index per_leg = whole_samples(leg, loop.sample_time);
  auto course = shaped_course(options.limits_at_motor(gear), loop.sample_time,
                              settled + legs * per_leg, 1, target);
  const Index rest = course.reference.size() - settled - first_legs * per_leg;
  return {std::move(course), per_leg, rest};
}

ReversalResult reverse(const SimulatedLoop& loop, const NonlinearVerificationOptions& options) {
  const auto [reference, per_leg, rest] = reversal_trajectory(loop, options);
  const LoopRun run = run_loop(loop, reference, {.noise = false});
  const LoopRun without_friction =
      run_loop(loop, reference, {.without = {Influence::friction}, .noise = false});
  ReversalResult result;
  result.status = run.status;
  result.message = run.message;
  result.encoder_error = result.boresight_error = result.encoder_error_without_friction =
      result.boresight_error_without_friction_feedforward = nan;
  result.leg = options.reversal_leg;
  result.trace = last_errors(run, loop.sample_time, rest);
  result.trace_without_friction = last_errors(without_friction, loop.sample_time, rest);
  if (without_friction.status == RunStatus::complete) {
    result.encoder_error_without_friction =
        without_friction.encoder_error.tail(rest).cwiseAbs().maxCoeff();
  }
  if (run.status != RunStatus::complete) return result;
  Index largest = 0;
  result.encoder_error = result.trace.encoder.cwiseAbs().maxCoeff(&largest);
  result.boresight_error = result.trace.boresight.cwiseAbs().maxCoeff();
  result.time_of_largest = loop.sample_time * static_cast<double>(largest % per_leg);
  return result;
}

// Adds the run without friction feedforward.
void explain_reversal(SimulatedLoop loop, const NonlinearVerificationOptions& options,
                      ReversalResult& result) {
  if (!loop.feedforward || loop.friction_feedforward == 0.0) return;
  loop.friction_feedforward = 0.0;
  const auto [reference, per_leg, rest] = reversal_trajectory(loop, options);
  const LoopRun run = run_loop(loop, reference, {.noise = false});
  if (run.status != RunStatus::complete) return;
  result.boresight_error_without_friction_feedforward =
      about_mean(run.boresight_error.tail(rest)).cwiseAbs().maxCoeff();
}

SlewResult slew(const SimulatedLoop& loop, const NonlinearVerificationOptions& options) {
  const double gear = loop.gear_ratio;
  SlewResult result;
  result.distance = options.slew_distance;
  const auto wanted = options.limits_at_motor(gear);
  const auto limits =
      achievable_limits(loop.antenna, plant::reflected_inertia(loop.linear), wanted);
  result.limits = {limits.rate / gear, limits.acceleration / gear};
  result.achievable_limits =
      limits.rate == wanted.rate && limits.acceleration == wanted.acceleration;
  result.largest_error = result.overshoot = nan;
  if (!(limits.rate > 0.0) || !(limits.acceleration > 0.0)) {
    result.status = RunStatus::failed;
    result.message = "the supply cannot move the antenna against its friction";
    return result;
  }
  constexpr double longest = 3600.0;  // s
  const double moving = control::min_move_time(limits, result.distance * gear);
  if (moving > longest) {
    result.status = RunStatus::failed;
    result.message = fmt::format("the move would take {:.3g} s", moving);
    return result;
  }
  const Index settled = whole_samples(options.settling, loop.sample_time);
  const Index end = settled + whole_samples(moving, loop.sample_time) + 2;
  const Index samples = end + whole_samples(options.settling_watched, loop.sample_time);
  const double begin = loop.sample_time * (static_cast<double>(settled) + 0.5);
  const auto course = shaped_course(limits, loop.sample_time, samples, 1, [&](double t) {
    return control::CommandSample{t > begin ? gear * result.distance : 0.0, 0.0, 0.0};
  });
  result.command_time = loop.sample_time * static_cast<double>(end - settled);
  const LoopRun run = run_loop(loop, course, {.noise = false});
  result.status = run.status;
  result.message = run.message;
  if (run.result.values.size() == 0) return result;
  result.at_command_limit = fraction_at_limit(loop, run);
  const VectorXd after = run.encoder_error.tail(run.encoder_error.size() - end);
  result.largest_error = run.encoder_error.segment(settled, end - settled).cwiseAbs().maxCoeff();
  const double sign = result.distance < 0.0 ? -1.0 : 1.0;
  result.overshoot = std::max(0.0, (sign * after).maxCoeff());
  Index out = -1;  // the last sample out of bounds
  for (Index k = 0; k < after.size(); ++k) {
    if (std::abs(after[k]) > options.settled_error) out = k;
  }
  // Not one that limit-cycles through the bound and happens to be within it at the end.
  const Index long_enough =
      whole_samples(std::min(10.0, 0.5 * options.settling_watched), loop.sample_time);
  if (after.size() - (out + 1) >= long_enough) {
    result.settling_time = loop.sample_time * static_cast<double>(out + 1);
    // Far behind on the way, but it arrived.
    result.status = RunStatus::complete;
    result.message.clear();
  }
  return result;
}

void check(const NonlinearVerificationOptions& options) {
  const auto require = [](bool satisfied, const char* expected, double found) {
    if (satisfied) return;
    throw InvalidInput(fmt::format("verify_in_time: expected {}, found {}", expected, found));
  };
  require(!options.seeds.empty(), "at least one seed", 0.0);
  require(options.wind_duration >= 1.0, "a wind_duration of at least 1 s", options.wind_duration);
  require(options.settling >= 0.0, "a settling time of at least 0 s", options.settling);
  require(options.limit_cycle_duration >= 1.0, "a limit_cycle_duration of at least 1 s",
          options.limit_cycle_duration);
  require(options.reversal_leg >= 1.0, "a reversal_leg of at least 1 s", options.reversal_leg);
  require(options.settling_watched >= 1.0, "a settling_watched of at least 1 s",
          options.settling_watched);
  require(std::abs(options.tracking_rate) <= options.limits.rate,
          "a tracking_rate within the command's rate limit", options.tracking_rate);
  require(std::isfinite(options.slew_distance), "a finite slew_distance", options.slew_distance);
  require(options.slew_distance == 0.0 || options.settled_error > 0.0,
          "a settled_error above 0 for a slew", options.settled_error);
}

}  // namespace

ErrorTrace error_in_wind(const TrackingProblem& problem, const SimulatedLoop& loop,
                         const NonlinearVerificationOptions& options) {
  NonlinearVerificationOptions one = options;
  if (one.seeds.size() > 1) one.seeds.erase(one.seeds.begin() + 1, one.seeds.end());
  one.explain = false;
  check(one);
  WindStudy wind(problem, loop, one);
  wind.run(0);
  return wind.first_trace();
}

void explain_in_wind(const TrackingProblem& problem, const SimulatedLoop& loop,
                     const NonlinearVerificationOptions& options, NonlinearVerification& known) {
  check(options);
  WindStudy wind(problem, loop, options);
  if (options.second_integrator) known.integrators.emplace();
  // The longest first.
  const std::size_t comparing = 0, reversal = 1, first_wind = 2;
  numerics::for_each_index(first_wind + wind.jobs(), options.threads, [&](std::size_t job) {
    if (job == comparing) {
      if (known.integrators) *known.integrators = wind.compare_integrators();
    } else if (job == reversal) {
      if (known.reversal && options.explain) explain_reversal(loop, options, *known.reversal);
    } else {
      wind.run(job - first_wind);
    }
  });
  known.wind = wind.result();
}

NonlinearVerification verify_in_time(const TrackingProblem& problem, const SimulatedLoop& loop,
                                     const NonlinearVerificationOptions& options) {
  check(options);
  WindStudy wind(problem, loop, options);
  NonlinearVerification result;
  std::vector<double> rates{0.0};
  if (options.tracking_rate != 0.0) {
    rates.push_back(options.tracking_rate);
    result.reversal.emplace();
  }
  std::vector<LimitCycleResult> limit_cycles(rates.size() * limit_cycle_starts);
  if (options.slew_distance != 0.0) result.slew.emplace();
  if (options.second_integrator) result.integrators.emplace();
  // The longest first; the runs in wind are many and even.
  const std::size_t comparing = 0, first_limit_cycle = 1,
                    reversal = first_limit_cycle + limit_cycles.size(), slewing = reversal + 1,
                    first_wind = slewing + 1;
  numerics::for_each_index(first_wind + wind.jobs(), options.threads, [&](std::size_t job) {
    if (job == comparing) {
      if (result.integrators) *result.integrators = wind.compare_integrators();
    } else if (job < reversal) {
      const std::size_t run = job - first_limit_cycle;
      limit_cycles[run] =
          limit_cycle_run(loop, options, rates[run / limit_cycle_starts], run % limit_cycle_starts);
    } else if (job == reversal) {
      if (!result.reversal) return;
      *result.reversal = reverse(loop, options);
      if (options.explain) explain_reversal(loop, options, *result.reversal);
    } else if (job == slewing) {
      if (result.slew) *result.slew = slew(loop, options);
    } else {
      wind.run(job - first_wind);
    }
  });
  result.limit_cycles.resize(rates.size());
  numerics::for_each_index(rates.size(), options.threads, [&](std::size_t i) {
    result.limit_cycles[i] = confirmed_limit_cycle(
        loop, options, rates[i],
        std::span(limit_cycles).subspan(i * limit_cycle_starts, limit_cycle_starts));
  });
  result.wind = wind.result();
  return result;
}

}  // namespace boresight::design
