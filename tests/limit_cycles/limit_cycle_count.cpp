// How often describing functions (design::LimitCyclePrediction), alone and with simulation of a
// reduced antenna (design::predicted_limit_cycle), miss the limit cycles that the nonlinear
// simulation shows, over random controllers, friction and encoders on one antenna:
//   boresight_limit_cycles CASE [FRICTIONS CONTROLLERS SEED THREADS]
// CONTROLLERS for each of FRICTIONS (default 40, 25, 1, 2). Prints a table for each prediction and
// how far the simulation agrees with itself; the time that predictions take goes to the error
// output.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <utility>
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

using Prediction = std::optional<design::PredictedLimitCycle>;

struct Outcome {
  design::LimitCycleResult simulated;
  std::vector<design::LimitCycleResult> runs;  // one from each start
  Prediction by_describing_functions;
  Prediction predicted;
  double step = 0.0;  // rad at the sky

  Prediction confirmed() const {
    return predicted && predicted->confirmed ? predicted : std::nullopt;
  }
};

constexpr double amplitude_tolerance = 0.3, frequency_tolerance = 0.2;

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
  int at_rest = 0, false_alarms = 0, false_alarms_beyond_a_step = 0;
  std::vector<Range> ranges{{"0.5 to 1", 0.5, 1.0},
                            {"1 to 3", 1.0, 3.0},
                            {"3 to 10", 3.0, 10.0},
                            {"above 10", 10.0, 1e300},
                            {"all", 0.0, 1e300}};
};

template <typename PredictionOf>
Count count(const std::vector<Outcome>& outcomes, const PredictionOf& prediction_of) {
  Count all;
  for (const Outcome& outcome : outcomes) {
    const design::LimitCycleResult& simulated = outcome.simulated;
    const double step = outcome.step;
    const Prediction predicted = prediction_of(outcome);
    if (simulated.status != design::RunStatus::complete) continue;
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

std::string with_percent(int part, int whole) {
  return fmt::format("{} ({:.1f} %)", part, whole > 0 ? 100.0 * part / whole : 0.0);
}

void print(const char* title, const Count& found) {
  fmt::print(
      "{}\n\n"
      "| amplitude simulated, encoder steps | loops | missed | amplitude within 30 % | frequency "
      "within 20 % |\n"
      "|---|---|---|---|---|\n",
      title);
  for (const Range& range : found.ranges) {
    const int predicted = range.cycles - range.missed;
    fmt::print("| {} | {} | {} | {} | {} |\n", range.name, range.cycles,
               with_percent(range.missed, range.cycles), with_percent(range.amplitudes, predicted),
               with_percent(range.frequencies, predicted));
  }
  fmt::print(
      "\nOf {} loops that come to rest from each of three starts, one is predicted for {}, of more "
      "than one encoder step for {}.\n\n",
      found.at_rest, with_percent(found.false_alarms, found.at_rest),
      with_percent(found.false_alarms_beyond_a_step, found.at_rest));
}

// How far the simulation agrees with itself: runs of one loop from two starts.
void print_agreement_of_starts(const std::vector<Outcome>& outcomes) {
  int pairs = 0, alike = 0, both = 0, near = 0;
  for (const Outcome& outcome : outcomes) {
    if (outcome.simulated.status != design::RunStatus::complete) continue;
    for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const auto& one = outcome.runs[i];
        const auto& other = outcome.runs[k];
        if (!one.limit_cycle && !other.limit_cycle) continue;
        ++pairs;
        alike += one.limit_cycle == other.limit_cycle ? 1 : 0;
        if (!one.limit_cycle || !other.limit_cycle) continue;
        ++both;
        const auto [small, large] = std::minmax(one.encoder_amplitude, other.encoder_amplitude);
        near += large <= (1.0 + amplitude_tolerance) * small ? 1 : 0;
      }
    }
  }
  fmt::print(
      "Of pairs of simulations from two starts of which one limit-cycles the other does in {}. Of "
      "pairs that both do, the amplitudes agree within 30 % in {}.\n",
      with_percent(alike, pairs), with_percent(near, both));
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
      of_confirmations(outcomes.size()), of_runs(outcomes.size());
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
      outcome.by_describing_functions = largest_stable(predicted, min_limit_cycle_amplitude(loop));
      start = Clock::now();
      outcome.predicted = predicted_limit_cycle(loop, prediction, options);
      of_confirmations[i * each + k] = milliseconds_since(start);
      outcome.step = loop.encoder_resolution / loop.gear_ratio;
      start = Clock::now();
      std::vector<design::LimitCycleResult> runs;
      for (std::size_t begin = 0; begin < design::limit_cycle_starts; ++begin) {
        runs.push_back(limit_cycle_run(loop, options, 0.0, begin));
      }
      of_runs[i * each + k] = milliseconds_since(start) / design::limit_cycle_starts;
      outcome.runs = runs;
      outcome.simulated = confirmed_limit_cycle(loop, options, 0.0, runs);
    }
  });

  const auto complete = std::ranges::count_if(outcomes, [](const Outcome& outcome) {
    return outcome.simulated.status == design::RunStatus::complete;
  });
  fmt::print(
      "{} loops at rest ({} frictions and encoders x {} controllers), {} simulated to the end. "
      "Amplitude and frequency are counted where one is predicted.\n\n",
      outcomes.size(), frictions, each, complete);
  print("Describing functions alone",
        count(outcomes, [](const Outcome& one) { return one.by_describing_functions; }));
  print("Confirmed by simulation of the reduced antenna",
        count(outcomes, [](const Outcome& one) { return one.confirmed(); }));
  print("Confirmed, or else by describing functions",
        count(outcomes, [](const Outcome& one) { return one.predicted; }));
  print_agreement_of_starts(outcomes);
  const auto mean = [](const std::vector<double>& times) {
    double sum = 0.0;
    for (const double time : times) sum += time;
    return sum / static_cast<double>(times.size());
  };
  fmt::print(stderr,
             "{:.0f} ms for the tables of a friction, {:.2f} ms for a controller by describing "
             "functions, {:.0f} ms with simulations of the reduced antenna, {:.0f} ms for a run of "
             "the whole one\n",
             mean(of_tables), mean(of_controllers), mean(of_confirmations), mean(of_runs));
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
