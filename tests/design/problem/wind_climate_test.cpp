#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/problem/wind_climate.hpp>
#include <boresight/numerics/error.hpp>

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

// Of all winds, by the distribution itself.
double fraction_above(const WeibullClimate& controller, double speed) {
  return std::exp(-std::pow(speed / controller.scale, controller.shape));
}

double mean_of(const WeibullClimate& controller) {
  return controller.scale * std::exp(std::lgamma(1.0 + 1.0 / controller.shape));
}

TEST(WindClimate, FindsTheDistributionOfAMeanAndOneExceedance) {
  // 9 mile/h on the average, 2 % of the time more than 30 mile/h.
  const double mile_per_hour = 0.44704;
  const auto found = weibull_shapes(30.0 / 9.0, 0.02);
  ASSERT_EQ(found.shapes.size(), 1U);
  EXPECT_NEAR(found.shapes[0], 1.19173678, 1e-8);
  const auto controller = weibull_climate(9.0 * mile_per_hour, found.shapes[0], 60.0);
  EXPECT_NEAR(controller.scale, 9.55059536 * mile_per_hour, 1e-8);
  EXPECT_NEAR(mean_of(controller), 9.0 * mile_per_hour, 1e-9);
  EXPECT_NEAR(fraction_above(controller, 30.0 * mile_per_hour), 0.02, 1e-12);
  EXPECT_NEAR(expectation(climate_speeds(controller), 1.0), 9.0 * mile_per_hour, 1e-4);
  for (const double shape : {0.9, 1.3, 2.0, 3.5, 8.0}) {
    for (const double ratio : {0.2, 0.7, 1.0, 2.0, 2.5}) {
      const double fraction = fraction_above(weibull_climate(1.0, shape, 10.0), ratio);
      if (fraction < 1e-200) continue;
      const auto again = weibull_shapes(ratio, fraction);
      ASSERT_EQ(again.shapes.size(), 1U) << shape << ' ' << ratio;
      EXPECT_NEAR(again.shapes[0], shape, 1e-6) << ratio;
      EXPECT_LE(again.min_fraction, fraction);
      EXPECT_GE(again.max_fraction, fraction);
    }
  }
}

TEST(WindClimate, FindsBothControllersOrNone) {
  // A little above the mean: 1.2 times it most winds exceed at a shape of 1.70.
  const auto both = weibull_shapes(1.2, 0.31);
  ASSERT_EQ(both.shapes.size(), 2U);
  EXPECT_LT(both.shapes[0], 1.7);
  EXPECT_GT(both.shapes[1], 1.7);
  for (const double shape : both.shapes) {
    EXPECT_NEAR(fraction_above(weibull_climate(1.0, shape, 10.0), 1.2), 0.31, 1e-12);
  }
  EXPECT_NEAR(both.max_fraction, 0.32525957, 1e-8);
  EXPECT_EQ(weibull_shapes(1.2, both.max_fraction * (1.0 - 1e-12)).shapes.size(), 1U);
  EXPECT_THAT(weibull_shapes(1.2, 0.33).shapes, testing::IsEmpty());
  const auto none = weibull_shapes(30.0 / 9.0, 0.08);
  EXPECT_THAT(none.shapes, testing::IsEmpty());
  EXPECT_NEAR(none.max_fraction, 0.05528453, 1e-8);
  EXPECT_EQ(none.min_fraction, 0.0);
  EXPECT_THAT(weibull_shapes(2.0, 1.0).shapes, testing::IsEmpty());
  for (const auto& [ratio, fraction] : {std::pair{0.0, 0.1}, std::pair{2.0, 0.0},
                                        std::pair{2.0, 1.1}, std::pair{std::nan(""), 0.1}}) {
    EXPECT_THROW(weibull_shapes(ratio, fraction), InvalidInput);
  }
}

TEST(WindClimate, SharesOutTheTime) {
  const WeibullClimate controller{6.0, 2.0, 9.0};
  const auto below = [](double v) { return 1.0 - std::exp(-v * v / 36.0); };
  EXPECT_NEAR(fraction_of_time({{controller}}, 5.0), below(5.0) / below(9.0), 1e-12);
  EXPECT_EQ(fraction_of_time({{controller}}, 9.0), 1.0);
  EXPECT_EQ(fraction_of_time({{controller}}, INFINITY), 1.0);
  EXPECT_EQ(fraction_of_time({{controller}}, 0.0), 0.0);
  const std::vector<ClimatePart> mixture{{controller, 3.0}, {12.0, 1.0}};
  EXPECT_NEAR(fraction_of_time(mixture, 5.0), 0.75 * below(5.0) / below(9.0), 1e-12);
  EXPECT_DOUBLE_EQ(fraction_of_time(mixture, 11.9), 0.75);
  EXPECT_EQ(fraction_of_time(mixture, 12.0), 1.0);
  EXPECT_EQ(highest_speed(mixture), 12.0);
  EXPECT_THROW(fraction_of_time({}, 5.0), InvalidInput);
}

TEST(WindClimate, TakesATableOfSpeedsAndFractions) {
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
