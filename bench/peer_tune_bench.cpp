// The peers' tuning: four gains for the least rms with Ms at most 2.
#include <cmath>
#include <ctime>
#include <optional>

#include <benchmark/benchmark.h>

#include "../tests/peer_tuning.hpp"
#include "../tests/random_numbers.hpp"

namespace {

using namespace boresight;

// One evaluation with gradients: rms and the peaks at the valve.
void peer_loop_evaluation(benchmark::State& state) {
  auto evaluator = reference::peer_evaluator(state.range(0));
  evaluator.look_at({false, true, false});
  const auto controller = reference::peer_controller({});
  for (auto _ : state) benchmark::DoNotOptimize(evaluator.evaluate(controller, true));
  state.counters["frequencies"] = static_cast<double>(evaluator.frequencies_used());
}
BENCHMARK(peer_loop_evaluation)->Arg(5)->Arg(50)->Arg(500)->Unit(benchmark::kMicrosecond);

// The same over stable controllers anywhere within a factor of ten, each new to the evaluator.
void peer_loop_evaluation_of_random_controllers(benchmark::State& state) {
  auto evaluator = reference::peer_evaluator(state.range(0));
  evaluator.look_at({false, true, false});
  reference::RandomNumbers random(31);
  for (auto _ : state) {
    state.PauseTiming();
    control::Controller controller;
    do {
      const auto near = [&](double gain) { return random.log_uniform(0.1 * gain, 10.0 * gain); };
      const auto& start = reference::peer_tuning_start;
      controller =
          reference::peer_controller({near(start.rate_gain), near(start.rate_integral),
                                      near(start.position_gain), near(start.position_integral)});
    } while (evaluator.evaluate(controller, false).unstable_closed_loop != 0);
    state.ResumeTiming();
    benchmark::DoNotOptimize(evaluator.evaluate(controller, true));
  }
}
BENCHMARK(peer_loop_evaluation_of_random_controllers)
    ->Arg(5)
    ->Arg(500)
    ->Iterations(2000)
    ->Unit(benchmark::kMicrosecond);

int starts_at_optimum(int starts) {
  reference::RandomNumbers random(11);
  int reached = 0;
  for (int i = 0; i < starts; ++i) {
    const auto near = [&](double gain) { return random.log_uniform(0.1 * gain, 10.0 * gain); };
    const auto& start = reference::peer_tuning_start;
    const auto tuning =
        reference::tune_peer(5, {near(start.rate_gain), near(start.rate_integral),
                                 near(start.position_gain), near(start.position_integral)});
    if (!tuning) continue;
    const auto evaluated = reference::evaluate_peer(5, tuning->gains);
    const bool there = evaluated.abscissa < 0.0 &&
                       std::abs(evaluated.rms / reference::peer_tuned_rms - 1.0) <= 1e-6 &&
                       evaluated.peak <= reference::peer_peak_limit * (1.0 + 1e-6);
    reached += there ? 1 : 0;
  }
  return reached;
}

// With its set-up, without the verification, whose values and time are given beside it.
void peer_tune_by_frequency_response(benchmark::State& state) {
  const Eigen::Index modes = state.range(0);
  std::optional<reference::PeerTuning> tuning;
  for (auto _ : state) tuning = reference::tune_peer(modes);
  if (!tuning) {
    state.SkipWithError("no controller with the peak within its limit");
    return;
  }
  state.counters["note_evaluations"] = static_cast<double>(tuning->evaluations);
  const std::clock_t begin = std::clock();
  // Where a dense evaluation takes minutes: adaptive quadrature and a bracketed peak, mode by mode.
  const bool dense = modes <= 50;
  const auto evaluated = dense ? reference::evaluate_peer(modes, tuning->gains)
                               : reference::evaluate_peer_by_modes(modes, tuning->gains);
  const auto spent = static_cast<double>(std::clock() - begin);
  state.counters["value0"] = evaluated.rms;
  state.counters["value1"] = evaluated.peak;
  state.counters["note_verification_ms"] = 1e3 * spent / CLOCKS_PER_SEC;
  if (dense) state.counters["note_closed_loop_abscissa"] = evaluated.abscissa;
  if (modes == 5) {
    static const int reached = starts_at_optimum(1000);
    state.counters["note_starts_at_optimum_of_1000"] = reached;
  }
}
BENCHMARK(peer_tune_by_frequency_response)
    ->Arg(5)
    ->Arg(20)
    ->Arg(50)
    ->Arg(500)
    ->Unit(benchmark::kMillisecond);

}  // namespace
