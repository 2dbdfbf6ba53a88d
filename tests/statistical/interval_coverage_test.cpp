#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/verification/simulated_rms.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

// The demo antenna with its friction, gears and oil, in records of half the usual length: mean
// squares of much shorter ones are so skewed that a symmetric interval covers less than it states.
struct Setting {
  Mission mission = reference::demo_mission();
  TrackingProblem problem = tracking_problem(mission);
  SimulatedLoop loop = make_simulated_loop(
      problem, plant::nonlinear_antenna(mission.antenna),
      {control::LoopStructure::pi_with_lag(), {0.1587, 0.42067, 2.6279, 10.258, 0.23531}});
  SimulatedRmsOptions options{.settling = 30.0,
                              .duration = 150.0,
                              .tracking_rate = mission.antenna.drive.tracking_rate,
                              .threads = std::thread::hardware_concurrency()};
};

// The mean of 200 records is itself the truth to a few tenths of what ten leave open: with the
// linear loop's response to 4000 winds its own error is small.
TEST(SimulatedRms, CoversTheMeanOf200RecordsIn90Of100Repetitions) {
  Setting setting;
  setting.options.records = 200;
  setting.options.winds = 4000;
  setting.options.seed = 1000000;
  const auto truth = simulated_rms(setting.problem, setting.loop, setting.options);
  ASSERT_EQ(truth.status, RunStatus::complete);
  setting.options.records = SimulatedRmsOptions{}.records;
  setting.options.winds = SimulatedRmsOptions{}.winds;
  constexpr int repetitions = 100;
  int covered = 0;
  double width = 0.0;
  for (int r = 0; r < repetitions; ++r) {
    setting.options.seed = 1 + 1000 * static_cast<std::uint64_t>(r);
    const auto found = simulated_rms(setting.problem, setting.loop, setting.options);
    if (found.rms.lower <= truth.rms.value && truth.rms.value <= found.rms.upper) ++covered;
    width += (found.rms.upper - found.rms.lower) / repetitions;
  }
  RecordProperty("covered", covered);
  EXPECT_GE(covered, 90);
  // An interval that covers by being wide decides nothing.
  EXPECT_LT(width, 0.5 * truth.rms.value);
  EXPECT_LT(truth.rms.standard_uncertainty, 0.25 * width);
}

}  // namespace
}  // namespace boresight::design
