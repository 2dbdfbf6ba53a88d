// How often describing functions (design::LimitCyclePrediction) miss the limit cycles that the
// nonlinear simulation shows, over random controllers, friction and encoders on one antenna:
//   boresight_limit_cycles CASE [FRICTIONS CONTROLLERS SEED THREADS]
// CONTROLLERS for each of FRICTIONS (default 40, 25, 1, 2). Prints a table; the time a prediction
// takes goes to the error output.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "random_loops.hpp"
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/verification/limit_cycle_prediction.hpp>
#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace {

using namespace boresight;
using Clock = std::chrono::steady_clock;

struct Outcome {
  design::LimitCycleResult simulated;
  std::optional<design::PredictedLimitCycle> predicted;
  double step = 0.0;  // rad at the sky
};

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Loops whose limit cycle has an amplitude in a range, in encoder steps.
struct Range {
  const char* name;
  double lower, upper;
  int cycles = 0, missed = 0, amplitudes = 0, frequencies = 0;  // within 30 % and 20 %
};

struct Count {
  int completed = 0, at_rest = 0, false_alarms = 0, false_alarms_beyond_a_step = 0;
  std::vector<Range> ranges{{"0.5 to 1", 0.5, 1.0},
                            {"1 to 3", 1.0, 3.0},
                            {"3 to 10", 3.0, 10.0},
                            {"above 10", 10.0, 1e300},
                            {"all", 0.0, 1e300}};
};

Count count(const std::vector<Outcome>& outcomes) {
  constexpr double amplitude_tolerance = 0.3, frequency_tolerance = 0.2;
  Count all;
  for (const auto& [simulated, predicted, step] : outcomes) {
    if (simulated.status != design::RunStatus::complete) continue;
    ++all.completed;
    if (!simulated.limit_cycle) {
      ++all.at_rest;
      all.false_alarms += predicted ? 1 : 0;
      all.false_alarms_beyond_a_step += predicted && predicted->encoder_amplitude > step ? 1 : 0;
      continue;
    }
    for (Range& range : all.ranges) {
      const double amplitude = simulated.encoder_amplitude;
      if (amplitude < range.lower * step || amplitude >= range.upper * step) continue;
      ++range.cycles;
      if (!predicted) {
        ++range.missed;
        continue;
      }
      const double frequency = simulated.frequency.value_or(0.0);
      range.amplitudes +=
          std::abs(predicted->encoder_amplitude / amplitude - 1.0) <= amplitude_tolerance ? 1 : 0;
      range.frequencies +=
          std::abs(predicted->frequency - frequency) <= frequency_tolerance * frequency ? 1 : 0;
    }
  }
  return all;
}

int run(const std::vector<std::string>& words) {
  const auto number = [&](std::size_t place, unsigned otherwise) {
    return words.size() > place ? static_cast<unsigned>(std::stoul(words[place])) : otherwise;
  };
  const unsigned frictions = number(1, 40), each = number(2, 25), seed = number(3, 1),
                 threads = number(4, 2);
  const design::Mission mission = io::mission_of(io::read_case(words.at(0)));
  const auto all = limit_cycles::random_loops(mission, frictions, each, seed, threads);

  std::vector<Outcome> outcomes(static_cast<std::size_t>(frictions) * each);
  std::vector<double> of_tables(frictions), of_controllers(outcomes.size()),
      of_runs(outcomes.size());
  numerics::for_each_index(all.size(), threads, [&](std::size_t i) {
    design::SimulatedLoop loop = all[i].antenna;
    auto start = Clock::now();
    const design::LimitCyclePrediction prediction(loop, 1);
    of_tables[i] = milliseconds_since(start);
    design::NonlinearVerificationOptions options;

    options.limits = {mission.antenna.drive.slew_rate, design::slew_acceleration};
    for (std::size_t k = 0; k < all[i].controllers.size(); ++k) {
      loop.controller = all[i].controllers[k];
      Outcome& outcome = outcomes[i * each + k];
      start = Clock::now();
      const auto predicted = prediction.of(loop.controller);
      of_controllers[i * each + k] = milliseconds_since(start);
      outcome.predicted = largest_stable(predicted, min_limit_cycle_amplitude(loop));
      outcome.step = loop.encoder_resolution / loop.gear_ratio;
      start = Clock::now();
      std::vector<design::LimitCycleResult> runs;
      for (std::size_t begin = 0; begin < design::limit_cycle_starts; ++begin) {
        runs.push_back(limit_cycle_run(loop, options, 0.0, begin));
      }
      of_runs[i * each + k] = milliseconds_since(start) / design::limit_cycle_starts;
      outcome.simulated = confirmed_limit_cycle(loop, options, 0.0, runs);
    }
  });

  const Count found = count(outcomes);
  fmt::print(
      "{} loops at rest ({} frictions and encoders x {} controllers), {} simulated to the end.\n\n",
      outcomes.size(), frictions, each, found.completed);
  fmt::print(
      "| amplitude simulated, encoder steps | loops | missed | amplitude within 30 % | frequency "
      "within 20 % |\n"
      "|---|---|---|---|---|\n");
  const auto with_percent = [](int part, int whole) {
    return fmt::format("{} ({:.1f} %)", part, whole > 0 ? 100.0 * part / whole : 0.0);
  };
  for (const Range& range : found.ranges) {
    fmt::print("| {} | {} | {} | {} | {} |\n", range.name, range.cycles,
               with_percent(range.missed, range.cycles),
               with_percent(range.amplitudes, range.cycles),
               with_percent(range.frequencies, range.cycles));
  }
  fmt::print(
      "\n{} loops come to rest from each of three starts. A limit cycle is predicted for {} of "
      "them, "
      "of more than one encoder step for {}.\n",
      found.at_rest, with_percent(found.false_alarms, found.at_rest),
      with_percent(found.false_alarms_beyond_a_step, found.at_rest));
  const auto mean = [](const std::vector<double>& times) {
    double sum = 0.0;
    for (const double time : times) sum += time;
    return sum / static_cast<double>(times.size());
  };
  fmt::print(stderr,
             "{:.0f} ms for the tables of a friction, {:.2f} ms for a controller, {:.0f} ms for a "
             "simulated run\n",
             mean(of_tables), mean(of_controllers), mean(of_runs));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty()) {
      fmt::print(stderr,
                 "usage: boresight_limit_cycles CASE [FRICTIONS CONTROLLERS SEED THREADS]\n");
      return 2;
    }
    return run(words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "boresight_limit_cycles: {}\n", error.what());
    return 1;
  }
}
