// The rms in wind on the nonlinear antenna: of ten records with its interval, beside the run of one
// record and beside the wind of one. CPU time of one thread.
#include <benchmark/benchmark.h>

#include "../tests/design/studies/demo_mission.hpp"
#include <boresight/design/verification/simulated_rms.hpp>
#include <boresight/design/verification/wind_course.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace {

using namespace boresight;
using namespace boresight::design;

struct Setting {
  Mission mission = reference::demo_mission();
  TrackingProblem problem = tracking_problem(mission);
  SimulatedLoop loop = make_simulated_loop(
      problem, plant::nonlinear_antenna(mission.antenna),
      {control::LoopStructure::pi_with_lag(), {0.1587, 0.42067, 2.6279, 10.258, 0.23531}});
  SimulatedRmsOptions options{.settling = 20.0,
                              .tracking_rate = mission.antenna.drive.tracking_rate};
  WindCourses courses{problem, loop, options.tracking_rate* loop.gear_ratio,
                      options.settling + options.duration};
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
