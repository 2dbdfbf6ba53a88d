#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::numerics {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Median, IsTheMiddleOneInAnyOrder) {
  EXPECT_EQ(median(std::vector<double>{3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median(std::vector<double>{4.0, 1.0, 3.0, 2.0}), 3.0);
  EXPECT_EQ(median(std::vector<double>{7.0}), 7.0);
  EXPECT_EQ(median(Eigen::VectorXd(Eigen::Vector3d(5.0, -1.0, 0.0))), 0.0);
  EXPECT_THAT(reference::Call([] { median(std::vector<double>()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least one value")));
}

TEST(Quantile, LiesStraightBetweenNeighbours) {
  const std::vector<double> rising{1.0, 2.0, 4.0};
  EXPECT_EQ(quantile(rising, 0.0), 1.0);
  EXPECT_EQ(quantile(rising, 0.25), 1.5);
  EXPECT_EQ(quantile(rising, 0.5), 2.0);
  EXPECT_EQ(quantile(rising, 0.75), 3.0);
  EXPECT_EQ(quantile(rising, 1.0), 4.0);
  EXPECT_EQ(quantile(std::vector<double>{5.0}, 0.3), 5.0);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(quantile(std::vector<double>{1.0, infinity, infinity}, 0.8), infinity);
  EXPECT_THAT(reference::Call([&] { quantile(rising, 97.5); }),
              ThrowsMessage<InvalidInput>(HasSubstr("fraction within [0, 1], found 3 and 97.5")));
  EXPECT_THROW(quantile(std::vector<double>(), 0.5), InvalidInput);
}

TEST(RankBelowQuantile, IsThatOfTheBinomialTable) {
  // W. J. Conover, Practical Nonparametric Statistics: of 99 samples the 40th bounds the median.
  EXPECT_EQ(rank_below_quantile(99, 0.5, 0.025), 39);
  // Of five the least lies above the median once in 32 times.
  EXPECT_EQ(rank_below_quantile(5, 0.5, 0.025), -1);
  EXPECT_EQ(rank_below_quantile(5, 0.5, 0.032), 0);
}

TEST(RankBelowQuantile, LiesAboveAsSeldomAsAsked) {
  reference::RandomNumbers random(17);
  constexpr int trials = 4000;
  constexpr std::size_t count = 60;
  const std::ptrdiff_t rank = rank_below_quantile(count, 0.3, 0.1);
  int above = 0, next_above = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> random_samples(count);
    for (double& draw : random_samples) draw = random.uniform(0.0, 1.0);
    std::ranges::sort(random_samples);
    above += random_samples[static_cast<std::size_t>(rank)] > 0.3 ? 1 : 0;
    next_above += random_samples[static_cast<std::size_t>(rank + 1)] > 0.3 ? 1 : 0;
  }
  const double error = std::sqrt(0.1 * 0.9 / trials);
  EXPECT_LT(above, trials * (0.1 + 4.0 * error));
  EXPECT_GT(next_above, trials * (0.1 - 4.0 * error));
}

}  // namespace
}  // namespace boresight::numerics
