#include <benchmark/benchmark.h>

#include "plant_family.hpp"
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>

namespace {

using boresight::plant_family;
using boresight::stable_controller;

void plant_response(benchmark::State& state) {
  const auto problem = plant_family(static_cast<int>(state.range(0)));
  const auto grid = boresight::plant::frequency_grid(problem.plant, 1e-4, 25.0, 300);
  for (auto _ : state) {
    benchmark::DoNotOptimize(boresight::plant::plant_response(problem.plant, grid));
  }
  state.counters["frequencies"] = static_cast<double>(grid.size());
}
BENCHMARK(plant_response)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void evaluate(benchmark::State& state) {
  auto evaluator =
      boresight::design::make_evaluator(plant_family(static_cast<int>(state.range(0))));
  const bool gradients = state.range(1) != 0;
  for (auto _ : state) benchmark::DoNotOptimize(evaluator.evaluate(stable_controller(), gradients));
  state.counters["frequencies"] = static_cast<double>(evaluator.response().frequency.size());
}
BENCHMARK(evaluate)->ArgsProduct({{5, 20, 50, 150}, {0, 1}});

void stability_by_eigenvalues(benchmark::State& state) {
  const auto problem = plant_family(static_cast<int>(state.range(0)));
  const auto grid = boresight::plant::frequency_grid(problem.plant, 1e-4, 25.0, 300);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        boresight::control::stability(problem.plant, stable_controller(), problem.delay, grid));
  }
}
BENCHMARK(stability_by_eigenvalues)->Arg(5)->Arg(20);

void rms_by_lyapunov(benchmark::State& state) {
  const auto problem = plant_family(static_cast<int>(state.range(0)));
  const auto filter = boresight::design::fit_wind_filter(problem.wind, problem.gear_ratio);
  for (auto _ : state) {
    benchmark::DoNotOptimize(boresight::control::lyapunov_rms(
        problem.plant, stable_controller(), problem.delay, filter, problem.noise));
  }
}
BENCHMARK(rms_by_lyapunov)->Arg(5)->Arg(20);

}  // namespace
