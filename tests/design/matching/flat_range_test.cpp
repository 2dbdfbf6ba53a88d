#include <limits>

#include <gtest/gtest.h>

#include <boresight/design/matching/flat_range.hpp>

namespace boresight::design {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(FlatRange, FindsTheLeastAndHowFlatItIs) {
  EXPECT_EQ(least_of({3.0, 1.0, nan, 2.0}), 1U);
  EXPECT_FALSE(least_of({nan, nan}));
  const std::vector<double> axis{0.0, 1.0, 2.0, 3.0, 4.0};
  const auto range = flat_range(axis, {1.2, 1.1, 1.0, 1.1, 1.2}, 0.05);
  EXPECT_NEAR(range.lowest, 1.5, 1e-12);
  EXPECT_NEAR(range.highest, 2.5, 1e-12);
  const auto end = flat_range(axis, {1.0, 1.01, 1.02, nan, 1.0}, 0.05);
  EXPECT_EQ(end.lowest, 0.0);
  EXPECT_EQ(end.highest, 2.0);
}

TEST(FlatRange, IsNoneWithoutAValue) {
  const auto range = flat_range({0.0, 1.0}, {nan, nan}, 0.05);
  EXPECT_NE(range.lowest, range.lowest);
  EXPECT_NE(range.highest, range.highest);
}

}  // namespace
}  // namespace boresight::design
