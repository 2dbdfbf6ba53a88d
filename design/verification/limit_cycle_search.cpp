#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <boresight/design/verification/friction_loop.hpp>
#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

// Steps at the start (rad at the sky): a loop may limit-cycle only once it was disturbed.
constexpr std::array<double, limit_cycle_starts> nudges{2.0 * millidegree, -1.0 * millidegree,
                                                        8.0 * millidegree};

using Simulation = LoopRun (*)(const SimulatedLoop&, const ReferenceTrajectory&);

LimitCycleResult watch(const SimulatedLoop& loop, const NonlinearVerificationOptions& options,
                       double rate, double nudge, double duration, Simulation simulate) {
  const double gear = loop.gear_ratio;
  LimitCycleResult result;
  result.rate = rate;
  const Index samples = whole_samples(options.settling + duration, loop.sample_time);
  const auto target = [&](double t) {
    return control::CommandSample{gear * (rate * t + (t > 0.0 ? nudge : 0.0)), gear * rate, 0.0};
  };
  const auto course =
      shaped_course(options.limits_at_motor(gear), loop.sample_time, samples, 1, target);
  const LoopRun run = simulate(loop, course);
  result.status = run.status;
  result.message = run.message;
  result.encoder_amplitude = result.boresight_amplitude = result.persistence = nan;
  result.valve_command_rms = nan;
  if (run.status != RunStatus::complete) return result;
  const Index half = whole_samples(0.5 * duration, loop.sample_time);
  const Index quarter = half / 2;
  const Swing encoder = swing_of(run.encoder_error.tail(half));
  result.encoder_amplitude = encoder.amplitude;
  const Swing boresight = swing_of(run.boresight_error.tail(half));
  result.boresight_amplitude = boresight.amplitude;
  const VectorXd command = plant::column(run.result, "valve_command").tail(half);
  result.valve_command_rms = std::sqrt((command.array() - command.mean()).square().mean());
  const Index kept = std::min(half, whole_samples(longest_limit_cycle_trace, loop.sample_time));
  result.trace = {loop.sample_time, boresight.values.tail(kept), encoder.values.tail(kept)};
  const double before =
      swing_of(run.encoder_error.segment(run.encoder_error.size() - half - quarter, quarter))
          .amplitude;
  result.persistence = before > 0.0 ? encoder.amplitude / before : 1.0;
  result.frequency = frequency_of(encoder, loop.sample_time);
  result.limit_cycle =
      encoder.amplitude > min_limit_cycle_amplitude(loop) && result.persistence > 0.8;
  return result;
}

LoopRun whole_antenna(const SimulatedLoop& loop, const ReferenceTrajectory& course) {
  return run_loop(loop, course, {.noise = false});
}

// That confirms a limit cycle.
LimitCycleResult longer_run(const SimulatedLoop& loop, const NonlinearVerificationOptions& options,
                            double rate, std::size_t start) {
  return watch(loop, options, rate, nudges.at(start),
               limit_cycle_confirmation * options.limit_cycle_duration, whole_antenna);
}

// Of the runs at one rate; the first of those alike.
std::size_t worst_of(std::span<const LimitCycleResult> runs) {
  const auto rank = [](const LimitCycleResult& run) {
    if (run.status != RunStatus::complete) return std::pair(2, 0.0);
    return run.limit_cycle ? std::pair(1, run.boresight_amplitude)
                           : std::pair(0, run.encoder_amplitude);
  };
  return static_cast<std::size_t>(std::ranges::max_element(runs, {}, rank) - runs.begin());
}

}  // namespace

double min_limit_cycle_amplitude(const SimulatedLoop& loop) {
  return std::max(0.5 * loop.encoder_resolution / loop.gear_ratio, 1e-3 * millidegree);
}

LimitCycleResult limit_cycle_run(const SimulatedLoop& loop,
                                 const NonlinearVerificationOptions& options, double rate,
                                 std::size_t start) {
  return watch(loop, options, rate, nudges.at(start), options.limit_cycle_duration, whole_antenna);
}

LimitCycleResult reduced_limit_cycle_run(const SimulatedLoop& loop,
                                         const NonlinearVerificationOptions& options,
                                         std::size_t start) {
  return watch(loop, options, 0.0, nudges.at(start), options.limit_cycle_duration,
               run_friction_loop);
}

LimitCycleResult confirmed_limit_cycle_run(const SimulatedLoop& loop,
                                           const NonlinearVerificationOptions& options, double rate,
                                           std::size_t start) {
  LimitCycleResult run = limit_cycle_run(loop, options, rate, start);
  return run.limit_cycle ? longer_run(loop, options, rate, start) : run;
}

LimitCycleResult confirmed_limit_cycle(const SimulatedLoop& loop,
                                       const NonlinearVerificationOptions& options, double rate,
                                       std::span<LimitCycleResult> runs) {
  std::array<bool, limit_cycle_starts> again{};
  std::size_t place = worst_of(runs);
  while (runs[place].limit_cycle && !again.at(place)) {
    again.at(place) = true;
    runs[place] = longer_run(loop, options, rate, place);
    place = worst_of(runs);
  }
  LimitCycleResult worst = runs[place];
  worst.starts = static_cast<int>(runs.size());
  worst.starts_with_limit_cycle =
      static_cast<int>(std::ranges::count_if(runs, &LimitCycleResult::limit_cycle));
  return worst;
}

double limit_cycle_amplitude(const std::vector<LimitCycleResult>& limit_cycles) {
  double largest = 0.0;
  for (const auto& run : limit_cycles) {
    if (run.limit_cycle) largest = std::max(largest, run.boresight_amplitude);
  }
  return largest;
}

bool limit_cycle_runs_complete(const std::vector<LimitCycleResult>& limit_cycles) {
  return std::ranges::all_of(
      limit_cycles, [](const LimitCycleResult& run) { return run.status == RunStatus::complete; });
}

bool is_limit_cycle_free(const std::vector<LimitCycleResult>& limit_cycles, double amplitude) {
  return limit_cycle_runs_complete(limit_cycles) &&
         limit_cycle_amplitude(limit_cycles) <= amplitude;
}

}  // namespace boresight::design
