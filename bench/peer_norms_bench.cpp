// Norms of the peers' family: rms of the pointing error in unit white noise, peaks.
#include <benchmark/benchmark.h>

#include "../tests/peer_family.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/analysis/spectral_rms.hpp>

namespace {

using namespace boresight;

void peer_rms_by_lyapunov(benchmark::State& state) {
  const auto system = reference::channel(reference::peer_closed_loop(state.range(0)), "n", "y");
  double rms = 0.0;
  for (auto _ : state) rms = control::h2_norm(system).value;
  state.counters["value0"] = rms;
}
BENCHMARK(peer_rms_by_lyapunov)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

void peer_rms_by_spectrum(benchmark::State& state) {
  const auto system = reference::peer_modal_system(state.range(0));
  control::SpectralRms result;
  for (auto _ : state) result = control::spectral_rms(plant::ModalResponse(system, "n", "y"));
  state.counters["value0"] = result.rms;
  state.counters["evaluations"] = static_cast<double>(result.evaluations);
}
BENCHMARK(peer_rms_by_spectrum)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void peer_rms_by_spectrum_to_a_millionth(benchmark::State& state) {
  const auto system = reference::peer_modal_system(state.range(0));
  control::SpectralRms result;
  for (auto _ : state) {
    result =
        control::spectral_rms(plant::ModalResponse(system, "n", "y"), {.relative_tolerance = 1e-6});
  }
  state.counters["value0"] = result.rms;
  state.counters["evaluations"] = static_cast<double>(result.evaluations);
}
BENCHMARK(peer_rms_by_spectrum_to_a_millionth)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void report(benchmark::State& state, const control::PeakGain& peak) {
  state.counters["value0"] = peak.lower;
  state.counters["value1"] = peak.frequency;
  state.counters["uncertainty"] = peak.upper / peak.lower - 1.0;
  state.counters["closed"] = peak.closed ? 1.0 : 0.0;
}

void peak_by_modes(benchmark::State& state, const char* input, const char* output) {
  const auto system = reference::peer_modal_system(state.range(0));
  control::PeakGain peak;
  for (auto _ : state) peak = control::peak_gain(system, input, output);
  report(state, peak);
}

void peak_dense(benchmark::State& state, const char* input, const char* output) {
  const auto system =
      reference::channel(reference::peer_closed_loop(state.range(0)), input, output);
  control::PeakGain peak;
  for (auto _ : state) peak = control::peak_gain(system);
  report(state, peak);
}

void peer_sensitivity_peak_by_modes(benchmark::State& state) {
  peak_by_modes(state, "d", "u");
}
BENCHMARK(peer_sensitivity_peak_by_modes)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void peer_sensitivity_peak_dense(benchmark::State& state) {
  peak_dense(state, "d", "u");
}
BENCHMARK(peer_sensitivity_peak_dense)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

void peer_wind_peak_by_modes(benchmark::State& state) {
  peak_by_modes(state, "t", "y");
}
BENCHMARK(peer_wind_peak_by_modes)->Arg(5)->Arg(20)->Arg(50)->Arg(150)->Arg(500);

void peer_wind_peak_dense(benchmark::State& state) {
  peak_dense(state, "t", "y");
}
BENCHMARK(peer_wind_peak_dense)->Arg(5)->Arg(20)->Arg(50)->Arg(150);

}  // namespace
