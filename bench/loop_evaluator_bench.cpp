// One evaluation with gradients of every goal of the reference antenna: rms by wind and noise,
// effort, the peaks of three sensitivities, four to ten gains.
#include <array>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "../tests/control/reference_loop.hpp"
#include <boresight/control/loops/loop_evaluator.hpp>

namespace {

using namespace boresight;

constexpr std::array structures{"PI-0", "PI", "DPF", "LL", "FULL", "PI+C", "DPF+C", "FULL+C"};

control::LoopEvaluator antenna_evaluator() {
  return {plant::PointResponse(reference::antenna()),
          {.delay = reference::delay,
           .noise = reference::sensor_noise(),
           .wind_spectrum = reference::motor_wind_spectrum,
           .quadrature = {.analysis = {1e-4, 100.0}, .band = {1e-4, 25.0}}}};
}

void antenna_evaluator_set_up(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(antenna_evaluator());
}
BENCHMARK(antenna_evaluator_set_up)->Unit(benchmark::kMicrosecond);

// Mean over forty stable controllers anywhere within the bounds.
void antenna_loop_evaluation(benchmark::State& state) {
  const auto structure =
      control::LoopStructure::named(structures.at(static_cast<std::size_t>(state.range(0))));
  auto evaluator = antenna_evaluator();
  reference::RandomNumbers random(41);
  std::vector<control::Controller> controllers;
  double frequencies = 0.0;
  while (controllers.size() < 40) {
    auto controller = reference::random_controller(random, structure);
    if (!evaluator.evaluate(controller, false).stable()) continue;
    frequencies += static_cast<double>(evaluator.frequencies_used()) / 40.0;
    controllers.push_back(std::move(controller));
  }
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(evaluator.evaluate(controllers[next], true));
    next = (next + 1) % controllers.size();
  }
  state.SetLabel(std::string(structures.at(static_cast<std::size_t>(state.range(0)))));
  state.counters["gains"] = static_cast<double>(structure.gains().size());
  state.counters["frequencies"] = frequencies;
}
BENCHMARK(antenna_loop_evaluation)->DenseRange(0, 7)->Unit(benchmark::kMicrosecond);

}  // namespace
