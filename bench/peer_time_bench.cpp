// Time domain of the peers' family: sampling at 1 ms and 600 s of response to a noise record.
#include <benchmark/benchmark.h>

#include "../tests/peer_family.hpp"
#include <boresight/control/analysis/step_characteristics.hpp>
#include <boresight/plant/linear/sampling.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace {

using namespace boresight;

constexpr double step = 1e-3;

void peer_sampling_zero_order_hold(benchmark::State& state) {
  const auto system = reference::channel(reference::peer_closed_loop(state.range(0)), "n", "y");
  plant::StateSpace sampled;
  for (auto _ : state) sampled = plant::sample(system, step);
  state.counters["value0"] = sampled.a.norm();
  state.counters["value1"] = sampled.b.norm();
}
BENCHMARK(peer_sampling_zero_order_hold)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void simulation(benchmark::State& state, plant::Interpolation interpolation) {
  const auto system = reference::channel(reference::peer_closed_loop(state.range(0)), "n", "y");
  const Eigen::MatrixXd noise = reference::peer_noise(600'000) / std::sqrt(step);
  Eigen::MatrixXd output(noise.rows(), 1);
  for (auto _ : state) {
    plant::LinearSimulation(system, step, {.interpolation = interpolation}).simulate(noise, output);
  }
  state.counters["value0"] = std::sqrt(output.squaredNorm() / static_cast<double>(output.rows()));
  state.counters["value1"] = output(output.rows() - 1, 0);
  state.counters["value2"] = output.cwiseAbs().maxCoeff();
}

void peer_simulation_zero_order_hold(benchmark::State& state) {
  simulation(state, plant::Interpolation::zero_order_hold);
}
BENCHMARK(peer_simulation_zero_order_hold)
    ->Arg(5)
    ->Arg(20)
    ->Arg(50)
    ->Arg(150)
    ->Unit(benchmark::kMillisecond);

void straight_simulation(benchmark::State& state) {
  simulation(state, plant::Interpolation::first_order_hold);
}
BENCHMARK(straight_simulation)->Arg(5)->Arg(50)->Unit(benchmark::kMillisecond);

void step_characteristics(benchmark::State& state) {
  // The complementary sensitivity: from d to what comes back, without the wind's states.
  auto system = reference::peer_open_loop(state.range(0));
  system.a -= system.b * system.c;
  for (auto _ : state) benchmark::DoNotOptimize(control::step_characteristics(system));
}
BENCHMARK(step_characteristics)->Arg(5)->Arg(20)->Arg(50)->Unit(benchmark::kMillisecond);

}  // namespace
