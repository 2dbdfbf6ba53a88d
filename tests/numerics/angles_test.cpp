#include <gtest/gtest.h>

#include <boresight/numerics/angles.hpp>

namespace boresight {
namespace {

TEST(Angles, AreThoseOfTheTurn) {
  EXPECT_DOUBLE_EQ(360.0 * degree, two_pi);
  EXPECT_DOUBLE_EQ(1e3 * millidegree, degree);
}

}  // namespace
}  // namespace boresight
