#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <boresight/io/description/key_unit.hpp>

namespace boresight::io {
namespace {

TEST(KeyUnit, NumbersAreWrittenInTheUnitOfTheirKey) {
  EXPECT_DOUBLE_EQ(in_unit(std::numbers::pi / 180.0, key_units::millidegree), 1000.0);
  EXPECT_DOUBLE_EQ(in_unit(std::numbers::pi / 180.0, key_units::degree), 1.0);
  EXPECT_DOUBLE_EQ(in_unit(2.0 * std::numbers::pi, key_units::hertz_of_radians), 1.0);
  EXPECT_DOUBLE_EQ(in_unit(2.0, {.multiplier = 3.0}), 6.0);
  EXPECT_EQ(in_unit(0.1, key_units::none), 0.1);
}

TEST(KeyUnit, DecibelsAreOfFactors) {
  EXPECT_DOUBLE_EQ(in_unit(10.0, key_units::decibel), 20.0);
  EXPECT_DOUBLE_EQ(in_unit(0.5, key_units::decibel), -20.0 * std::log10(2.0));
  EXPECT_FALSE(std::isfinite(in_unit(0.0, key_units::decibel)));
  EXPECT_TRUE(std::isnan(in_unit(-1.0, key_units::decibel)));
  EXPECT_EQ(in_unit(3.0, key_units::decibel_as_kept), 3.0);
}

TEST(KeyUnit, KeysEndInTheirUnit) {
  EXPECT_EQ(key_with_unit("rate", key_units::millidegree_per_second), "rate_mdeg_per_s");
  EXPECT_EQ(key_with_unit("value", key_units::none), "value");
  EXPECT_EQ(key_with_unit("value", without_suffix(key_units::degree)), "value");
  EXPECT_EQ(without_suffix(key_units::degree).divisor, key_units::degree.divisor);
}

}  // namespace
}  // namespace boresight::io
