// Norms of the peers' family: rms of the pointing error in unit white noise, peaks.
#include <benchmark/benchmark.h>

#include "../tests/peer_family.hpp"
#include <boresight/control/lyapunov.hpp>

namespace {

using namespace boresight;

void peer_rms_by_lyapunov(benchmark::State& state) {
  const auto system = reference::channel(reference::peer_closed_loop(state.range(0)), "n", "y");
  double rms = 0.0;
  for (auto _ : state) {
    const Eigen::MatrixXd covariance =
        control::solve_lyapunov(system.a, system.b * system.b.transpose(), {false}).covariance;
    rms = std::sqrt((system.c * covariance * system.c.transpose())(0, 0));
  }
  state.counters["value0"] = rms;
}
BENCHMARK(peer_rms_by_lyapunov)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

}  // namespace
