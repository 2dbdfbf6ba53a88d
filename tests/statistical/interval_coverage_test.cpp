#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

#include "design/verification/demo_loop.hpp"
#include <boresight/design/verification/simulated_rms.hpp>

namespace boresight::design {
namespace {

// The mean of 200 records is itself the truth to a few tenths of what ten leave open: with the
// linear loop's response to 4000 winds its own error is small.
TEST(SimulatedRms, CoversTheMeanOf200RecordsIn90Of100Repetitions) {
  reference::DemoLoop setting;
  // Half the usual length: mean squares of much shorter records are so skewed that a symmetric
  // interval covers less than it states.
  setting.options.settling = 30.0;
  setting.options.duration = 150.0;
  setting.options.threads = std::thread::hardware_concurrency();
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
