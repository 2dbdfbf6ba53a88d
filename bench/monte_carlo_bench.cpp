// 100 000 plants, each with other structure, oil, leakage, friction and inertias, under one
// controller with fixed gains; and how far a second thread speeds that up beside a loop of
// arithmetic alone.
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "../tests/design/reference_problem.hpp"
#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace {

using namespace boresight;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t plants = 100000;

plant::AntennaPlant uncertain_antenna(std::uint64_t index) {
  const auto within = [&](std::uint64_t input, double lower, double upper) {
    const auto bits = numerics::splitmix64(7, 6 * index + input) >> 11U;
    return lower + (upper - lower) * static_cast<double>(bits) * 0x1p-53;
  };
  auto structure = reference::structure();
  const double scale = within(0, 0.95, 1.05);
  structure.locked_rotor_frequency *= scale;
  for (auto& mode : structure.modes) mode.frequency *= scale;
  structure.antenna_inertia *= within(1, 0.95, 1.05);
  plant::AntennaPlant plant = reference::antenna();
  plant.structure = plant::make_structure(structure);
  plant.drive.oil_stiffness *= within(2, 0.8, 1.33);
  plant.drive.leakage_rate *= within(3, 0.3, 1.0);
  plant.drive.viscous_friction = within(4, 0.0, 12.0);
  plant.drive.motor_inertia *= within(5, 0.95, 1.05);
  return plant;
}

design::MonteCarlo study(std::uint64_t count) {
  return {.problem = reference::tracking_problem(),
          .controller = reference::cautious_gains(),
          .goals = {},
          .plants = count,
          .plant = uncertain_antenna};
}

double plants_seconds(std::uint64_t count, unsigned threads) {
  design::MonteCarloRun run(study(count));
  const auto start = Clock::now();
  run.work_on(run.missing_blocks(), {.threads = threads});
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Multiplications and additions in registers: nothing that threads could share.
double arithmetic_seconds(unsigned threads) {
  constexpr int blocks = 400, steps = 400000;
  std::atomic<int> next{0};
  const auto start = Clock::now();
  {
    std::vector<std::jthread> workers;
    for (unsigned t = 0; t < threads; ++t) {
      workers.emplace_back([&] {
        while (next++ < blocks) {
          double x = 0.5;
          for (int i = 0; i < steps; ++i) x = 3.7 * x * (1.0 - x);
          benchmark::DoNotOptimize(x);
        }
      });
    }
  }
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void fixed_gain_ensemble(benchmark::State& state) {
  const auto threads = static_cast<unsigned>(state.range(0));
  for (auto _ : state) state.SetIterationTime(plants_seconds(plants, threads));
  state.counters["plants"] = static_cast<double>(plants);
}
BENCHMARK(fixed_gain_ensemble)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

// In turn, five times, so that a busy machine is busy for both: the best of each. `fraction` is the
// speed-up of the plants over that of arithmetic.
void two_threads_against_arithmetic(benchmark::State& state) {
  constexpr std::uint64_t some = 20000;
  for (auto _ : state) {
    double one = 1e9, two = 1e9, arithmetic_one = 1e9, arithmetic_two = 1e9;
    for (int round = 0; round < 5; ++round) {
      arithmetic_one = std::min(arithmetic_one, arithmetic_seconds(1));
      one = std::min(one, plants_seconds(some, 1));
      arithmetic_two = std::min(arithmetic_two, arithmetic_seconds(2));
      two = std::min(two, plants_seconds(some, 2));
    }
    state.counters["plants_speed_up"] = one / two;
    state.counters["arithmetic_speed_up"] = arithmetic_one / arithmetic_two;
    state.counters["relative_speed_up"] = one / two / (arithmetic_one / arithmetic_two);
  }
}
BENCHMARK(two_threads_against_arithmetic)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
