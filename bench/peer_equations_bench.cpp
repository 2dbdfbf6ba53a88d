// Matrix equations of the peers' family: 20 states with 5 modes.
#include <benchmark/benchmark.h>

#include "../tests/peer_family.hpp"
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/equations/riccati.hpp>
#include <boresight/control/reduction/balanced_truncation.hpp>
#include <boresight/control/reduction/gramians.hpp>
#include <boresight/control/reduction/modal_truncation.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace {

using namespace boresight;

plant::StateSpace noise_to_pointing(const benchmark::State& state) {
  return reference::channel(reference::peer_closed_loop(state.range(0)), "n", "y");
}

void lyapunov(benchmark::State& state, bool estimate_condition) {
  const auto system = noise_to_pointing(state);
  const Eigen::MatrixXd intensity = system.b * system.b.transpose();
  double trace = 0.0;
  for (auto _ : state) {
    trace = control::solve_lyapunov(system.a, intensity, {estimate_condition}).covariance.trace();
  }
  state.counters["value0"] = trace;
}

void peer_lyapunov_with_condition(benchmark::State& state) {
  lyapunov(state, true);
}
BENCHMARK(peer_lyapunov_with_condition)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

void peer_lyapunov_alone(benchmark::State& state) {
  lyapunov(state, false);
}
BENCHMARK(peer_lyapunov_alone)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

/// Weight 1 on the pointing error and on the valve command.
control::RiccatiProblem regulator(const plant::StateSpace& system) {
  return {system.a, system.b, system.c.transpose() * system.c, Eigen::MatrixXd::Identity(1, 1), {}};
}

void peer_riccati_continuous(benchmark::State& state) {
  const auto problem =
      regulator(reference::channel(reference::peer_closed_loop(state.range(0)), "d", "y"));
  double trace = 0.0;
  for (auto _ : state) trace = control::solve_riccati(problem).x.trace();
  state.counters["value0"] = trace;
}
BENCHMARK(peer_riccati_continuous)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

void peer_discrete_riccati_sampled(benchmark::State& state) {
  const auto system = reference::channel(reference::peer_closed_loop(state.range(0)), "d", "y");
  const auto problem = regulator(plant::sample(system, reference::peer_regulator_period));
  double trace = 0.0;
  for (auto _ : state) trace = control::solve_discrete_riccati(problem).x.trace();
  state.counters["value0"] = trace;
}
BENCHMARK(peer_discrete_riccati_sampled)->Arg(5)->Arg(20)->Arg(50);

void hankel_singular_values(benchmark::State& state) {
  const auto system = noise_to_pointing(state);
  for (auto _ : state) benchmark::DoNotOptimize(control::hankel_singular_values(system));
}
BENCHMARK(hankel_singular_values)->Arg(5)->Arg(20)->Arg(50);

void truncate_balanced(benchmark::State& state) {
  const auto system = noise_to_pointing(state);
  for (auto _ : state) benchmark::DoNotOptimize(control::truncate_balanced(system, {.order = 10}));
}
BENCHMARK(truncate_balanced)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

void truncate_modes(benchmark::State& state) {
  const auto system = noise_to_pointing(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(control::truncate_modes(system, {.error_bound = 0.1}));
  }
}
BENCHMARK(truncate_modes)->Arg(5)->Arg(20)->Arg(50);

}  // namespace
