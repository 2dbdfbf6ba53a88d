// Time domain of the peers' family: sampling at 1 ms and 600 s of response to a noise record.
#include <benchmark/benchmark.h>

#include "../tests/peer_family.hpp"
#include <boresight/plant/sampling.hpp>

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
BENCHMARK(peer_sampling_zero_order_hold)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

}  // namespace
