// The rms in wind on the nonlinear antenna: of ten records with its interval, beside the run of one
// record and beside the wind of one. CPU time of one thread.
#include <benchmark/benchmark.h>

#include "../tests/design/verification/demo_loop.hpp"
#include <boresight/design/verification/simulated_rms.hpp>
#include <boresight/design/verification/wind_course.hpp>

namespace {

using namespace boresight;
using namespace boresight::design;

// Records of the usual length, on one thread.
struct Setting : reference::DemoLoop {
  Setting() {
    options.duration = SimulatedRmsOptions{}.duration;
    options.threads = 1;
  }
  WindCourses courses{problem, loop, options.tracking_rate* loop.gear_ratio,
                      options.settling + SimulatedRmsOptions{}.duration};
};

void rms_of_one_record(benchmark::State& state) {
  const Setting setting;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    LoopRunOptions how;
    how.seed = ++seed;
    benchmark::DoNotOptimize(run_loop(setting.loop, setting.courses.course(how.seed), how));
  }
}
BENCHMARK(rms_of_one_record)->Unit(benchmark::kMillisecond);

void rms_of_ten_records(benchmark::State& state) {
  Setting setting;
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulated_rms(setting.problem, setting.loop, setting.options));
    setting.options.seed += 1000;
  }
}
BENCHMARK(rms_of_ten_records)->Unit(benchmark::kMillisecond);

void wind_of_one_record(benchmark::State& state) {
  const Setting setting;
  std::uint64_t seed = 0;
  for (auto _ : state) benchmark::DoNotOptimize(setting.courses.gusts(++seed));
}
BENCHMARK(wind_of_one_record)->Unit(benchmark::kMillisecond);

}  // namespace
