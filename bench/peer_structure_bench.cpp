// Zeros, minimal realisations and the exact sampled closed loop on the peers' family.
#include <benchmark/benchmark.h>

#include "../tests/peer_family.hpp"
#include <boresight/control/analysis/transmission_zeros.hpp>
#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/plant/linear/minimal_realisation.hpp>

namespace {

using namespace boresight;

void transmission_zeros(benchmark::State& state) {
  const auto loop = reference::peer_open_loop(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(control::transmission_zeros(loop));
}
BENCHMARK(transmission_zeros)->Arg(5)->Arg(20)->Arg(50);

void minimal_realisation(benchmark::State& state) {
  // The wind's two states are not reached from the valve.
  const auto system = reference::channel(reference::peer_closed_loop(state.range(0)), "d", "y");
  for (auto _ : state) benchmark::DoNotOptimize(plant::minimal_realisation(system));
}
BENCHMARK(minimal_realisation)->Arg(5)->Arg(20)->Arg(50);

/// The antenna with a slow correction of its pointing error, sampled at 50 Hz with one sample of
/// delay.
void sampled_loop_rms(benchmark::State& state) {
  control::SampledLoop loop;
  loop.plant = reference::peer_closed_loop(state.range(0));
  loop.plant.outputs[1] = "command";
  loop.controller = plant::static_gain(Eigen::MatrixXd::Constant(1, 1, 1e-5), {"y"}, {"d"});
  loop.controller.sample_time = loop.computation_delay = 0.02;
  control::SampledLoopRms rms;
  for (auto _ : state) rms = control::sampled_loop_rms(loop, {{{"n", 1.0}}, {}}, {"y"});
  state.counters["rms"] = rms.over_time[0];
}
BENCHMARK(sampled_loop_rms)->Arg(5)->Arg(20)->Arg(50);

}  // namespace
