#include <gtest/gtest.h>

#include <boresight/design/audit/physical_check.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

TEST(PhysicalCheck, FailsWithTheFirstNumberOutsideItsBounds) {
  PhysicalCheck check{"wave_speed", "line.longest.slosh_frequency"};
  check.add("first", 1214.0, "m/s");
  check.add("on its bound", 1.0, "m/s", 1.0, 1.0);
  EXPECT_TRUE(check.holds);
  check.add("below", 0.9, "m/s", 1.0);
  EXPECT_FALSE(check.holds);
  check.add("within", 1.0, "m/s", 0.0, 2.0);
  EXPECT_FALSE(check.holds) << "once failed it does not hold again";
}

TEST(PhysicalCheck, GivesNumbersByName) {
  PhysicalCheck check{"wave_speed", ""};
  check.add("speed", 1214.0, "m/s", 1.0, 2.0);
  EXPECT_EQ(check.number("speed").value, 1214.0);
  EXPECT_EQ(check.number("speed").upper, 2.0);
  EXPECT_THROW(check.number("pressure"), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
