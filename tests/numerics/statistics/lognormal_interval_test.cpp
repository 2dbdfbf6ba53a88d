#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/lognormal_interval.hpp>

namespace boresight::numerics {
namespace {

TEST(LognormalInterval, IsNormalInTheLogarithm) {
  const Interval interval = lognormal_interval(3.0, 0.2);
  const Interval logarithm = normal_interval(std::log(3.0), 0.2);
  EXPECT_EQ(interval.value, 3.0);
  EXPECT_DOUBLE_EQ(interval.standard_uncertainty, 0.6);
  EXPECT_NEAR(interval.lower, std::exp(logarithm.lower), 1e-12);
  EXPECT_NEAR(interval.upper, std::exp(logarithm.upper), 1e-12);
  EXPECT_EQ(lognormal_interval(3.0, 0.0).upper, 3.0);
}

TEST(LognormalInterval, RefusesWhatHasNoLogarithm) {
  EXPECT_THROW(lognormal_interval(0.0, 0.1), InvalidInput);
  EXPECT_THROW(lognormal_interval(1.0, -0.1), InvalidInput);
  EXPECT_THROW(lognormal_interval(1.0, std::numeric_limits<double>::infinity()), InvalidInput);
}

}  // namespace
}  // namespace boresight::numerics
