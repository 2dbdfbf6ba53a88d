#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/verification/simulated_rms.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

struct Setting {
  Mission mission = reference::demo_mission();
  TrackingProblem problem = tracking_problem(mission);
  SimulatedLoop loop = make_simulated_loop(
      problem, plant::nonlinear_antenna(mission.antenna),
      {control::LoopStructure::pi_with_lag(), {0.1587, 0.42067, 2.6279, 10.258, 0.23531}});
  SimulatedRmsOptions options{.settling = 20.0,
                              .duration = 60.0,
                              .tracking_rate = mission.antenna.drive.tracking_rate,
                              .threads = 2};
};

TEST(SimulatedRms, IsTheSameForAnyNumberOfThreads) {
  Setting setting;
  setting.options.records = 4;
  setting.options.winds = 8;
  const auto two = simulated_rms(setting.problem, setting.loop, setting.options);
  setting.options.threads = 1;
  const auto one = simulated_rms(setting.problem, setting.loop, setting.options);
  EXPECT_EQ(two.status, RunStatus::complete);
  EXPECT_EQ(one.rms.value, two.rms.value);
  EXPECT_EQ(one.rms.upper, two.rms.upper);
  EXPECT_LT(one.rms.lower, one.rms.value);
  EXPECT_GT(one.rms.upper, one.rms.value);
}

// The truth by 200 records of its own against the intervals of ten each; 95 % of 20 intervals, less
// three standard deviations of a binomial count.
TEST(SimulatedRms, CoversTheMeanOfManyRecords) {
  Setting setting;
  setting.options.records = 200;
  setting.options.winds = 200;
  setting.options.seed = 100000;
  const double truth = simulated_rms(setting.problem, setting.loop, setting.options).rms.value;
  setting.options.records = 10;
  setting.options.winds = 100;
  constexpr int repetitions = 20;
  int covered = 0;
  double width = 0.0;
  for (int r = 0; r < repetitions; ++r) {
    setting.options.seed = 1 + 1000 * static_cast<std::uint64_t>(r);
    const auto found = simulated_rms(setting.problem, setting.loop, setting.options);
    if (found.rms.lower <= truth && truth <= found.rms.upper) ++covered;
    width += (found.rms.upper - found.rms.lower) / repetitions;
  }
  EXPECT_GE(covered, 16);
  EXPECT_LT(width, 0.5 * truth);
}

TEST(SimulatedRms, StatesARunThatLosesItsTarget) {
  Setting setting;
  setting.options.records = 4;
  setting.options.winds = 4;
  setting.loop.antenna.valve.stroke_limit *= 0.01;
  setting.options.tracking_rate *= 50.0;
  const auto found = simulated_rms(setting.problem, setting.loop, setting.options);
  EXPECT_NE(found.status, RunStatus::complete);
  EXPECT_TRUE(std::isnan(found.rms.value));
}

TEST(SimulatedRms, RefusesTooFewRecords) {
  Setting setting;
  setting.options.records = 3;
  EXPECT_THROW(simulated_rms(setting.problem, setting.loop, setting.options), InvalidInput);
  setting.options.records = 10;
  setting.options.winds = 9;
  EXPECT_THROW(simulated_rms(setting.problem, setting.loop, setting.options), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
