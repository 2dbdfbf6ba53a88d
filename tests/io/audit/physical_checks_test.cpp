#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include "io/audit/failed_checks.hpp"
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/drive_numbers.hpp>

namespace boresight::io {
namespace {

TEST(ShaftNumbers, FollowFromWhatIsPrintedNearest) {
  const Case antenna = read_case(case_path("dss14-70m"));
  const ShaftNumbers shaft = shaft_numbers(antenna, case_graph(antenna));
  EXPECT_NEAR(shaft.motors, 4.0 * antenna.motor->inertia.value, 1e-3 * shaft.motors);
  const double ratio = gear_ratio(antenna);
  EXPECT_NEAR(shaft.antenna, antenna.antenna->inertia.value / (ratio * ratio),
              1e-3 * shaft.antenna);
  EXPECT_NEAR(shaft.slew_rate, 0.25 * std::numbers::pi / 180.0 * ratio, 1e-9);
  EXPECT_EQ(shaft.supply_torque, supply_torque(antenna));
  EXPECT_GT(shaft.gear_train, 0.0);
}

// Where a check has bounds, no number of one that holds is outside of them.
TEST(PhysicalChecks, ThatHoldAreWithinTheirBounds) {
  std::size_t holding = 0, failing = 0;
  for (const char* name : {"dss14-70m", "dss14-64m"}) {
    const Case antenna = read_case(case_path(name));
    for (const auto& check : check_physics(antenna, case_graph(antenna)).checks) {
      ++(check.holds ? holding : failing);
      EXPECT_FALSE(check.id.empty());
      EXPECT_FALSE(check.quantity.empty());
      for (const auto& number : check.numbers) {
        EXPECT_TRUE(std::isfinite(number.value)) << check.id << " " << number.name;
        if (!check.holds) continue;
        EXPECT_GE(number.value, number.lower) << check.id << " " << number.name;
        EXPECT_LE(number.value, number.upper) << check.id << " " << number.name;
      }
    }
  }
  EXPECT_GT(holding, 10U);
  EXPECT_GT(failing, 10U);
}

}  // namespace
}  // namespace boresight::io
