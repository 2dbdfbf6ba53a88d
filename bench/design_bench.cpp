#include <benchmark/benchmark.h>

#include "plant_family.hpp"
#include <boresight/design/tuning/design_study.hpp>

namespace {

void tune(benchmark::State& state) {
  const auto problem = boresight::plant_family(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        boresight::design::tune(problem, boresight::control::LoopStructure::pi_with_lag(), {}, {}));
  }
}
BENCHMARK(tune)->Arg(5)->Unit(benchmark::kMillisecond);

void verify(benchmark::State& state) {
  const auto problem = boresight::plant_family(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        boresight::design::verify(problem, boresight::stable_controller(), {}));
  }
}
BENCHMARK(verify)->Arg(5)->Unit(benchmark::kMillisecond);

}  // namespace
