#include <benchmark/benchmark.h>

#include "../tests/peer_family.hpp"
#include <boresight/control/lyapunov.hpp>

namespace {

using boresight::plant::StateSpace;
using boresight::reference::channel;
using boresight::reference::peer_closed_loop;

StateSpace noise_to_pointing(const benchmark::State& state) {
  return channel(peer_closed_loop(state.range(0)), "n", "y");
}

void peer_rms_by_lyapunov(benchmark::State& state) {
  const StateSpace system = noise_to_pointing(state);
  double rms = 0.0;
  for (auto _ : state) {
    const auto covariance =
        boresight::control::solve_lyapunov(system.a, system.b * system.b.transpose()).covariance;
    rms = std::sqrt((system.c * covariance * system.c.transpose())(0, 0));
  }
  state.counters["value0"] = rms;
}
BENCHMARK(peer_rms_by_lyapunov)->Arg(5)->Arg(20)->Arg(50);

}  // namespace
