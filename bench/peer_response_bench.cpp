// 1000-point frequency response from wind torque to pointing error, preparation included but in
// `prepared`, which is to be held against programs that set their formulas up beforehand.
#include <benchmark/benchmark.h>

#include "../tests/peer_family.hpp"
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/modal_form.hpp>
#include <boresight/plant/modal/modal_response.hpp>

namespace {

using namespace boresight;
using reference::channel;
using reference::peer_closed_loop;
using reference::peer_frequencies;

void report(benchmark::State& state, const Eigen::ArrayXcd& response) {
  state.counters["value0"] = response.abs().maxCoeff();
  state.counters["value1"] = response.real().sum();
  state.counters["value2"] = response.imag().sum();
}

void peer_response_by_modes(benchmark::State& state) {
  const auto system = reference::peer_modal_system(state.range(0));
  const Eigen::ArrayXd w = peer_frequencies();
  Eigen::ArrayXcd response(w.size());
  for (auto _ : state) plant::ModalResponse(system, "t", "y").evaluate(w, response);
  report(state, response);
}
BENCHMARK(peer_response_by_modes)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void peer_response_prepared(benchmark::State& state) {
  const plant::ModalResponse prepared(reference::peer_modal_system(state.range(0)), "t", "y");
  const Eigen::ArrayXd w = peer_frequencies();
  Eigen::ArrayXcd response(w.size());
  for (auto _ : state) prepared.evaluate(w, response);
  report(state, response);
}
BENCHMARK(peer_response_prepared)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void peer_response_dense(benchmark::State& state) {
  const auto system = channel(peer_closed_loop(state.range(0)), "t", "y");
  const Eigen::ArrayXd w = peer_frequencies();
  Eigen::ArrayXcd response(w.size());
  for (auto _ : state) plant::DenseResponse(system).evaluate(w, response);
  report(state, response);
}
BENCHMARK(peer_response_dense)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void modal_form(benchmark::State& state) {
  const auto system = channel(peer_closed_loop(state.range(0)), "t", "y");
  for (auto _ : state) benchmark::DoNotOptimize(plant::modal_form(system));
}
BENCHMARK(modal_form)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

}  // namespace
