#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/wind_climate.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::design {
namespace {

double expectation(const std::vector<WeightedSpeed>& speeds, double power) {
  double sum = 0.0;
  for (const auto& one : speeds) sum += one.weight * std::pow(one.speed, power);
  return sum;
}

// E v^p = scale^p Gamma(1 + p/shape)
TEST(WindClimate, HasTheMomentsOfWeibullsLaw) {
  for (const double shape : {1.0, 1.5, 2.0, 2.3, 4.0}) {
    const auto speeds = climate_speeds(WeibullClimate{5.0, shape, 1000.0});
    for (const double power : {0.0, 1.0, 2.0, 3.0, 4.0, 6.0}) {
      const double exact = std::pow(5.0, power) * std::tgamma(1.0 + power / shape);
      EXPECT_NEAR(expectation(speeds, power) / exact, 1.0, 1e-6) << shape << ' ' << power;
    }
  }
}

// With shape 2 and V = v^2: E V below the limit, by parts.
TEST(WindClimate, IsConditionalOnTheAntennaTracking) {
  const double scale = 6.0, highest = 9.0;
  const auto speeds = climate_speeds(WeibullClimate{scale, 2.0, highest});
  const double x = highest * highest / (scale * scale);
  const double exact = scale * scale * (1.0 - (1.0 + x) * std::exp(-x)) / (1.0 - std::exp(-x));
  EXPECT_NEAR(expectation(speeds, 2.0) / exact, 1.0, 1e-9);
  EXPECT_NEAR(expectation(speeds, 0.0), 1.0, 1e-12);
  for (const auto& one : speeds) EXPECT_LE(one.speed, highest);
}

TEST(WindClimate, ScalesWithTheSpeed) {
  const auto slow = climate_speeds(WeibullClimate{4.0, 1.8, 20.0});
  const auto fast = climate_speeds(WeibullClimate{8.0, 1.8, 40.0});
  ASSERT_EQ(slow.size(), fast.size());
  for (std::size_t i = 0; i < slow.size(); ++i) {
    EXPECT_NEAR(fast[i].speed, 2.0 * slow[i].speed, 1e-12);
    EXPECT_NEAR(fast[i].weight, slow[i].weight, 1e-12);
  }
}

TEST(WindClimate, SharesOutTheTime) {
  const WeibullClimate law{6.0, 2.0, 9.0};
  const auto below = [](double v) { return 1.0 - std::exp(-v * v / 36.0); };
  EXPECT_NEAR(share_of_time({{law}}, 5.0), below(5.0) / below(9.0), 1e-12);
  EXPECT_EQ(share_of_time({{law}}, 9.0), 1.0);
  EXPECT_EQ(share_of_time({{law}}, INFINITY), 1.0);
  EXPECT_EQ(share_of_time({{law}}, 0.0), 0.0);
  const std::vector<ClimatePart> mixture{{law, 3.0}, {12.0, 1.0}};
  EXPECT_NEAR(share_of_time(mixture, 5.0), 0.75 * below(5.0) / below(9.0), 1e-12);
  EXPECT_DOUBLE_EQ(share_of_time(mixture, 11.9), 0.75);
  EXPECT_EQ(share_of_time(mixture, 12.0), 1.0);
  EXPECT_EQ(highest_speed(mixture), 12.0);
  EXPECT_THROW(share_of_time({}, 5.0), InvalidInput);
}

TEST(WindClimate, TakesATableOfSpeedsAndShares) {
  const auto speeds = climate_speeds({{5.0, 30.0}, {7.0, 0.0}, {10.0, 10.0}});
  ASSERT_EQ(speeds.size(), 2U);
  EXPECT_DOUBLE_EQ(speeds[0].weight, 0.75);
  EXPECT_DOUBLE_EQ(speeds[1].speed, 10.0);
  EXPECT_DOUBLE_EQ(speeds[1].weight, 0.25);
}

std::string refusal(const auto& climate) {
  try {
    climate_speeds(climate);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(WindClimate, RefusesWhatIsNoClimate) {
  for (const WeibullClimate& wrong :
       {WeibullClimate{0.0, 2.0, 20.0}, WeibullClimate{5.0, 0.2, 20.0},
        WeibullClimate{5.0, 2.0, 0.0}, WeibullClimate{std::nan(""), 2.0, 20.0}}) {
    EXPECT_THAT(refusal(wrong), testing::HasSubstr("a shape of 0.5 to 10, found"));
  }
  using Table = std::vector<WeightedSpeed>;
  EXPECT_THAT(refusal(Table{}), testing::HasSubstr("a weight above 0, found none"));
  EXPECT_THAT(refusal(Table{{5.0, 0.0}}), testing::HasSubstr("a weight above 0, found none"));
  EXPECT_THAT(refusal(Table{{0.0, 1.0}}), testing::HasSubstr("found 0 m/s of weight 1"));
  EXPECT_THAT(refusal(Table{{5.0, -1.0}}), testing::HasSubstr("found 5 m/s of weight -1"));
}

}  // namespace
}  // namespace boresight::design
