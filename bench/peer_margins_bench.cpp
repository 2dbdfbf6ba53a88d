// All crossovers, margins and peaks of the peers' loop, cut at the valve command.
#include <benchmark/benchmark.h>

#include "../tests/peer_modal_family.hpp"
#include <boresight/control/analysis/crossovers.hpp>
#include <boresight/control/analysis/modal_margins.hpp>

namespace {

using namespace boresight;

void report(benchmark::State& state, const control::Margins& margins) {
  state.counters["value0"] = margins.increasing_gain_margin;
  state.counters["value2"] = margins.decreasing_gain_margin;
  for (const auto& crossover : margins.phase_crossovers) {
    if (crossover.gain_margin == margins.increasing_gain_margin) {
      state.counters["value1"] = crossover.frequency;
    }
    if (crossover.gain_margin == margins.decreasing_gain_margin) {
      state.counters["value3"] = crossover.frequency;
    }
  }
  state.counters["value4"] = margins.phase_margin_deg;
  state.counters["value5"] = margins.gain_crossovers.front().frequency;
}

void peer_margins_by_scan(benchmark::State& state) {
  const auto loop = reference::peer_open_loop(state.range(0));
  control::Margins margins;
  for (auto _ : state) margins = control::margins(loop);
  report(state, margins);
}
BENCHMARK(peer_margins_by_scan)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

void peer_margins_by_modes(benchmark::State& state) {
  const auto system = reference::peer_modal_open_loop(state.range(0));
  control::Margins margins;
  for (auto _ : state) {
    margins = control::margins(plant::ModalResponse(system, "d", "loop_gain"));
  }
  report(state, margins);
}
BENCHMARK(peer_margins_by_modes)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void crossovers_by_eigenvalues(benchmark::State& state) {
  const auto loop = reference::peer_open_loop(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(control::crossovers(loop));
}
BENCHMARK(crossovers_by_eigenvalues)->Arg(5)->Arg(20)->Arg(50)->Unit(benchmark::kMillisecond);

}  // namespace
