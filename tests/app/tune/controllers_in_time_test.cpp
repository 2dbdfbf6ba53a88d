#include <limits>

#include <gtest/gtest.h>

#include <boresight/app/tune/controllers_in_time.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

TunedController controller_of_test() {
  TunedController row;
  row.boresight_rms = 0.4 * millidegree;
  row.in_time = {true, 0.0, 0.42 * millidegree};
  return row;
}

TEST(EvaluatedAgainst, IsEmptyForAControllerWithoutFault) {
  EXPECT_EQ(evaluated_against(controller_of_test()), "");
  TunedController linear = controller_of_test();
  linear.in_time.reset();
  EXPECT_EQ(evaluated_against(linear), "");
}

TEST(EvaluatedAgainst, NamesTheFault) {
  TunedController row = controller_of_test();
  row.in_time->limit_cycle_free = false;
  row.in_time->limit_cycles = 2.6 * millidegree;
  EXPECT_EQ(evaluated_against(row), "limit-cycles by +-2.60 mdeg");
  row.in_time->limit_cycles = 0.0;
  EXPECT_EQ(evaluated_against(row), "is not shown free of limit cycles");
  row = controller_of_test();
  row.in_time->boresight_rms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(evaluated_against(row), "does not complete the run in wind");
}

}  // namespace
}  // namespace boresight::app
