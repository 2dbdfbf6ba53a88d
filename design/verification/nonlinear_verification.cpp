#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/problem/drive_reach.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/design/verification/wind_course.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int continuous = 16;  // times as many samples stand for a continuous loop

Index whole_samples(double duration, double sample_time) {
  return static_cast<Index>(std::llround(duration / sample_time));
}

// What is kept of a run in wind.
struct WindRun {
  RunStatus status = RunStatus::complete;
  std::string message;
  double beam_variance = 0.0;
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
  return {interval, about_mean(run.beam_error.tail(count)), run.encoder_error.tail(count)};
}

double share_at_limit(const SimulatedLoop& loop, const LoopRun& run) {
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
  const Index rest = run.beam_error.size() - settled;
  kept.beam_variance = variance(run.beam_error.tail(rest));
  kept.encoder_variance = variance(run.encoder_error.tail(rest));
  kept.at_command_limit = share_at_limit(loop, run);
  return kept;
}

// One kind of run in wind over the seeds.
struct Pooled {
  RunStatus status = RunStatus::complete;
  std::string message;
  double beam_rms = 0.0;
  double encoder_rms = 0.0;
  double at_command_limit = 0.0;
};

Pooled pool(const WindRun* runs, std::size_t count) {
  Pooled pooled;
  for (std::size_t i = 0; i < count; ++i) {
    const WindRun& run = runs[i];
    if (run.status > pooled.status) pooled.status = run.status;
    if (pooled.message.empty()) pooled.message = run.message;
    pooled.beam_rms += run.beam_variance;
    pooled.encoder_rms += run.encoder_variance;
    pooled.at_command_limit += run.at_command_limit / static_cast<double>(count);
  }
  const auto root_of_mean = [&](double sum) {
    return pooled.status == RunStatus::complete ? std::sqrt(sum / static_cast<double>(count)) : nan;
  };
  pooled.beam_rms = root_of_mean(pooled.beam_rms);
  pooled.encoder_rms = root_of_mean(pooled.encoder_rms);
  return pooled;
}

// Runs in wind: every kind with every seed, the seeds of a kind in a row.
class WindStudy {
 public:
  WindStudy(const TrackingProblem& problem, const SimulatedLoop& loop,
            const NonlinearVerificationOptions& options)
      : problem_(problem), loop_(loop), options_(options) {
    const WindCourses courses(problem, loop, options.tracking_rate * loop.gear_ratio,
                              options.settling + options.wind_duration);
    for (const std::uint64_t seed : options.seeds) courses_.push_back(courses.course(seed));
    if (options.explain) {
      for (const Influence influence : influences) {
        if (has(loop, influence)) switched_.push_back(influence);
      }
    }
    runs_.resize((switched_.size() + first_switched) * options.seeds.size());
  }

  std::size_t jobs() const { return runs_.size(); }

  void run(std::size_t job) {
    const std::size_t kind = job / options_.seeds.size();
    const std::size_t seed = job % options_.seeds.size();
    const LoopCourse& course = courses_[seed];
    LoopRunOptions how;
    how.seed = options_.seeds[seed];
    if (kind >= first_switched) how.without = {switched_[kind - first_switched]};
    const LoopRun run = kind == linear_kind       ? run_linear_loop(loop_, course, 1, how)
                        : kind == continuous_kind ? run_linear_loop(loop_, course, continuous, how)
                                                  : run_loop(loop_, course, how);
    const Index settled = whole_samples(options_.settling, loop_.sample_time);
    runs_[job] = keep(loop_, run, settled);
    if (kind != whole_kind || seed != 0) return;
    ErrorTrace& trace = runs_[job].trace;
    trace = last_errors(run, course.interval, course.reference.size() - settled);
    if (trace.encoder.size() > 0) trace.encoder = about_mean(trace.encoder);
  }

  const ErrorTrace& first_trace() const { return runs_.front().trace; }

  IntegratorAgreement compare_integrators() const {
    return integrator_agreement(loop_, courses_.front(),
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
    result.beam_rms = whole.beam_rms;
    result.encoder_rms = whole.encoder_rms;
    result.at_command_limit = whole.at_command_limit;
    result.trace = first_trace();
    control::LoopEvaluator evaluator = make_evaluator(problem_);
    result.predicted_rms =
        std::sqrt(evaluator.evaluate(loop_.law, false).beam_variance()) / loop_.gear_ratio;
    result.linear_rms = kind(linear_kind).beam_rms;
    result.continuous_rms = kind(continuous_kind).beam_rms;
    result.chance = result.continuous_rms - result.predicted_rms;
    result.sampling = result.linear_rms - result.continuous_rms;
    result.joint = result.beam_rms - result.linear_rms;
    for (std::size_t i = 0; i < switched_.size(); ++i) {
      const Pooled without = kind(first_switched + i);
      result.influences.push_back(
          {switched_[i], without.status, without.beam_rms, result.beam_rms - without.beam_rms});
      result.joint -= result.influences.back().difference;
    }
    return result;
  }

 private:
  static constexpr std::size_t whole_kind = 0, linear_kind = 1, continuous_kind = 2,
                               first_switched = 3;

  const TrackingProblem& problem_;
  const SimulatedLoop& loop_;
  const NonlinearVerificationOptions& options_;
  std::vector<LoopCourse> courses_;
  std::vector<Influence> switched_;
  std::vector<WindRun> runs_;
};

// The limits of the command preprocessor at the motor.
control::CommandLimits at_motor(const NonlinearVerificationOptions& options, double gear_ratio) {
  return {options.limits.rate * gear_ratio, options.limits.acceleration * gear_ratio};
}

LoopRunOptions without_noise() {
  LoopRunOptions options;
  options.noise = false;
  return options;
}

// Half of peak to peak about a straight line through the values.
struct Swing {
  double amplitude = 0.0;
  VectorXd values;  // the line taken off
};

Swing swing_of(const VectorXd& values) {
  const Index count = values.size();
  const VectorXd place = VectorXd::LinSpaced(count, -1.0, 1.0);
  const double slope = place.dot(values) / place.squaredNorm();
  Swing swing{0.0, values - slope * place};
  swing.values.array() -= swing.values.mean();
  swing.amplitude = 0.5 * (swing.values.maxCoeff() - swing.values.minCoeff());
  return swing;
}

// Whole periods between upward passages, each armed by a fall below a quarter of the amplitude.
std::optional<double> frequency_of(const Swing& swing, double interval) {
  const double threshold = 0.25 * swing.amplitude;
  bool armed = false;
  Index first = -1, last = -1, passages = 0;
  for (Index k = 0; k < swing.values.size(); ++k) {
    if (swing.values[k] < -threshold) armed = true;
    if (!armed || swing.values[k] <= threshold) continue;
    armed = false;
    ++passages;
    last = k;
    if (first < 0) first = k;
  }
  if (passages < 3) return std::nullopt;
  return static_cast<double>(passages - 1) / (interval * static_cast<double>(last - first));
}

// Steps at the start (rad at the sky): a loop may hunt only once it was disturbed.
constexpr std::array<double, hunting_starts> nudges{2.0 * millidegree, -1.0 * millidegree,
                                                    8.0 * millidegree};

HuntingResult watch(const SimulatedLoop& loop, const NonlinearVerificationOptions& options,
                    double rate, double nudge, double duration) {
  const double gear = loop.gear_ratio;
  HuntingResult result;
  result.rate = rate;
  const Index samples = whole_samples(options.settling + duration, loop.sample_time);
  const auto target = [&](double t) {
    return control::CommandSample{gear * (rate * t + (t > 0.0 ? nudge : 0.0)), gear * rate, 0.0};
  };
  const auto course = shaped_course(at_motor(options, gear), loop.sample_time, samples, 1, target);
  const LoopRun run = run_loop(loop, course, without_noise());
  result.status = run.status;
  result.message = run.message;
  result.encoder_amplitude = result.beam_amplitude = result.persistence = nan;
  if (run.status != RunStatus::complete) return result;
  const Index half = whole_samples(0.5 * duration, loop.sample_time);
  const Index quarter = half / 2;
  const Swing encoder = swing_of(run.encoder_error.tail(half));
  result.encoder_amplitude = encoder.amplitude;
  const Swing beam = swing_of(run.beam_error.tail(half));
  result.beam_amplitude = beam.amplitude;
  const Index kept = std::min(half, whole_samples(longest_hunting_trace, loop.sample_time));
  result.trace = {loop.sample_time, beam.values.tail(kept), encoder.values.tail(kept)};
  const double before =
      swing_of(run.encoder_error.segment(run.encoder_error.size() - half - quarter, quarter))
          .amplitude;
  result.persistence = before > 0.0 ? encoder.amplitude / before : 1.0;
  result.frequency = frequency_of(encoder, loop.sample_time);
  const double least = std::max(0.5 * loop.encoder_resolution / gear, 1e-3 * millidegree);
  result.limit_cycle = encoder.amplitude > least && result.persistence > 0.8;
  return result;
}

HuntingResult hunt(const SimulatedLoop& loop, const NonlinearVerificationOptions& options,
                   double rate, double nudge) {
  HuntingResult seen = watch(loop, options, rate, nudge, options.hunting_duration);
  if (!seen.limit_cycle) return seen;
  return watch(loop, options, rate, nudge, hunting_confirmation * options.hunting_duration);
}

// Of the runs at one rate; the first of those alike.
HuntingResult worst_of(std::span<const HuntingResult> runs) {
  const auto rank = [](const HuntingResult& run) {
    if (run.status != RunStatus::complete) return std::pair(2, 0.0);
    return run.limit_cycle ? std::pair(1, run.beam_amplitude) : std::pair(0, run.encoder_amplitude);
  };
  HuntingResult worst = *std::ranges::max_element(runs, {}, rank);
  worst.starts = static_cast<int>(runs.size());
  worst.starts_hunting = static_cast<int>(std::ranges::count_if(runs, &HuntingResult::limit_cycle));
  return worst;
}

ReversalResult reverse(const SimulatedLoop& loop, const NonlinearVerificationOptions& options) {
  const double gear = loop.gear_ratio;
  const double leg = options.reversal_leg;
  constexpr Index legs = 6;
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
  const auto course =
      shaped_course(at_motor(options, gear), loop.sample_time, settled + legs * per_leg, 1, target);
  const LoopRun run = run_loop(loop, course, without_noise());
  LoopRunOptions frictionless = without_noise();
  frictionless.without = {Influence::friction};
  const LoopRun without_friction = run_loop(loop, course, frictionless);
  ReversalResult result;
  result.status = run.status;
  result.message = run.message;
  result.encoder_error = result.beam_error = result.encoder_error_without_friction = nan;
  // The first reversals set the loop swinging; those after them repeat.
  const Index first = settled + 2 * per_leg;
  const Index rest = course.reference.size() - first;
  result.leg = leg;
  result.trace = last_errors(run, loop.sample_time, rest);
  result.trace_without_friction = last_errors(without_friction, loop.sample_time, rest);
  if (without_friction.status == RunStatus::complete) {
    result.encoder_error_without_friction =
        without_friction.encoder_error.tail(rest).cwiseAbs().maxCoeff();
  }
  if (run.status != RunStatus::complete) return result;
  Index largest = 0;
  result.encoder_error = result.trace.encoder.cwiseAbs().maxCoeff(&largest);
  result.beam_error = result.trace.boresight.cwiseAbs().maxCoeff();
  result.time_of_largest = loop.sample_time * static_cast<double>(largest % per_leg);
  return result;
}

SlewResult slew(const SimulatedLoop& loop, const NonlinearVerificationOptions& options) {
  const double gear = loop.gear_ratio;
  SlewResult result;
  result.distance = options.slew_distance;
  const auto wanted = at_motor(options, gear);
  const auto limits = within_reach(loop.antenna, plant::reflected_inertia(loop.linear), wanted);
  result.limits = {limits.rate / gear, limits.acceleration / gear};
  result.within_reach = limits.rate == wanted.rate && limits.acceleration == wanted.acceleration;
  result.largest_error = result.overshoot = nan;
  if (!(limits.rate > 0.0) || !(limits.acceleration > 0.0)) {
    result.status = RunStatus::failed;
    result.message = "the supply cannot move the antenna against its friction";
    return result;
  }
  constexpr double longest = 3600.0;  // s
  const double moving = control::least_move_time(limits, result.distance * gear);
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
  const LoopRun run = run_loop(loop, course, without_noise());
  result.status = run.status;
  result.message = run.message;
  if (run.result.values.size() == 0) return result;
  result.at_command_limit = share_at_limit(loop, run);
  const VectorXd after = run.encoder_error.tail(run.encoder_error.size() - end);
  result.largest_error = run.encoder_error.segment(settled, end - settled).cwiseAbs().maxCoeff();
  const double sign = result.distance < 0.0 ? -1.0 : 1.0;
  result.overshoot = std::max(0.0, (sign * after).maxCoeff());
  Index out = -1;  // the last sample out of bounds
  for (Index k = 0; k < after.size(); ++k) {
    if (std::abs(after[k]) > options.settled_error) out = k;
  }
  // Not one that hunts through the bound and happens to be within it at the end.
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
  require(options.hunting_duration >= 1.0, "a hunting_duration of at least 1 s",
          options.hunting_duration);
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

double hunting_amplitude(const std::vector<HuntingResult>& hunting) {
  double largest = 0.0;
  for (const auto& run : hunting) {
    if (run.limit_cycle) largest = std::max(largest, run.beam_amplitude);
  }
  return largest;
}

bool hunting_seen(const std::vector<HuntingResult>& hunting) {
  return std::ranges::all_of(
      hunting, [](const HuntingResult& run) { return run.status == RunStatus::complete; });
}

double hunting_limit(double error) {
  return std::numbers::sqrt2 * error;
}

bool holds_still(const std::vector<HuntingResult>& hunting, double error) {
  return hunting_seen(hunting) && hunting_amplitude(hunting) <= hunting_limit(error);
}

ErrorTrace error_in_wind(const TrackingProblem& problem, const SimulatedLoop& loop,
                         const NonlinearVerificationOptions& options) {
  NonlinearVerificationOptions one = options;
  one.seeds.resize(std::min<std::size_t>(one.seeds.size(), 1));
  one.explain = false;
  check(one);
  WindStudy wind(problem, loop, one);
  wind.run(0);
  return wind.first_trace();
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
  std::vector<HuntingResult> hunting(rates.size() * nudges.size());
  if (options.slew_distance != 0.0) result.slew.emplace();
  if (options.second_integrator) result.integrators.emplace();
  // The longest first; the runs in wind are many and even.
  const std::size_t comparing = 0, first_hunting = 1, reversal = first_hunting + hunting.size(),
                    slewing = reversal + 1, first_wind = slewing + 1;
  numerics::for_each_index(first_wind + wind.jobs(), options.threads, [&](std::size_t job) {
    if (job == comparing) {
      if (result.integrators) *result.integrators = wind.compare_integrators();
    } else if (job < reversal) {
      const std::size_t run = job - first_hunting;
      hunting[run] = hunt(loop, options, rates[run / nudges.size()], nudges[run % nudges.size()]);
    } else if (job == reversal) {
      if (result.reversal) *result.reversal = reverse(loop, options);
    } else if (job == slewing) {
      if (result.slew) *result.slew = slew(loop, options);
    } else {
      wind.run(job - first_wind);
    }
  });
  for (std::size_t i = 0; i < rates.size(); ++i) {
    result.hunting.push_back(
        worst_of(std::span(hunting).subspan(i * nudges.size(), nudges.size())));
  }
  result.wind = wind.result();
  return result;
}

}  // namespace boresight::design
