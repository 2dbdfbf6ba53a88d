#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/pooled_mean.hpp>

namespace boresight::numerics {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(PooledMean, OfEstimatesThatAgreeIsTheWeightedMean) {
  const auto pooled = pooled_mean({{10.0, 1.0}, {10.5, 2.0}});
  EXPECT_NEAR(pooled.mean.value, (10.0 + 10.5 / 4.0) / 1.25, 1e-12);
  EXPECT_NEAR(pooled.mean.standard_uncertainty, 1.0 / std::sqrt(1.25), 1e-12);
  EXPECT_EQ(pooled.between, 0.0);
  // Of two: the square of their difference over the sum of the variances.
  EXPECT_NEAR(pooled.heterogeneity, 0.25 / 5.0, 1e-12);
  EXPECT_EQ(pooled.degrees_of_freedom, 1);
  EXPECT_NEAR(pooled.reduced_chi_squared(), 0.25 / 5.0, 1e-12);
}

TEST(PooledMean, OfEstimatesThatDoNotAgreeRestsOnTheirScatter) {
  const auto pooled = pooled_mean({{9.0, 1e-3}, {11.0, 1e-3}, {10.0, 1e-3}, {10.0, 1e-3}});
  EXPECT_NEAR(pooled.mean.value, 10.0, 1e-9);
  // Sample variance 2/3 of four.
  EXPECT_NEAR(pooled.between, std::sqrt(2.0 / 3.0), 1e-3);
  EXPECT_NEAR(pooled.mean.standard_uncertainty, std::sqrt(2.0 / 3.0 / 4.0), 1e-3);
  EXPECT_EQ(pooled_mean({{3.0, 0.2}}).reduced_chi_squared(), 0.0);
  EXPECT_NEAR(pooled_mean({{3.0, 0.2}}).mean.standard_uncertainty, 0.2, 1e-15);
}

TEST(PooledMean, RefusesNoneAndTheUncertaintyOfCertainty) {
  EXPECT_THAT(reference::Call([] { pooled_mean({}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected at least one estimate")));
  EXPECT_THAT(reference::Call([] {
                pooled_mean({{1.0, 0.0}});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive uncertainties, found 1 +- 0")));
}

}  // namespace
}  // namespace boresight::numerics
