#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/commissioning/plant_band.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

TEST(PlantBand, IsStudentsIntervalForOneMorePlant) {
  // Normal numbers are asked for what they are, positive ones for their logarithms.
  const auto linear = plant_band(0.5, {-1.0, 0.0, 1.0, 2.0}, 0.5);
  EXPECT_EQ(linear.lower, 0.0);
  EXPECT_EQ(linear.upper, 2.0);  // 0.5 + 0.765 sqrt(5/3 5/4) is within the plants' own
  EXPECT_EQ(linear.minimum, -1.0);
  const double e = std::exp(1.0);
  const auto logarithmic = plant_band(1.0, {1.0, e, e * e}, 0.99);
  // t of 2 degrees at 99.5 %: 9.924843; mean 1, deviation 1.
  EXPECT_NEAR(std::log(logarithmic.upper), 1.0 + 9.924843 * std::sqrt(4.0 / 3.0), 1e-5);
  EXPECT_NEAR(std::log(logarithmic.lower), 1.0 - 9.924843 * std::sqrt(4.0 / 3.0), 1e-5);
  EXPECT_EQ(logarithmic.nominal, 1.0);
  const auto none = plant_band(1.0, {1.0, 2.0, std::numeric_limits<double>::infinity()}, 0.9);
  EXPECT_TRUE(std::isnan(none.upper));
  EXPECT_THROW(plant_band(1.0, {1.0, 2.0}, 0.9), InvalidInput);
  EXPECT_THROW(plant_band(1.0, {1.0, 2.0, 3.0}, 99.0), InvalidInput);
}

TEST(PlantBand, OfEitherSignIsNotCutAtZero) {
  const auto band = signed_plant_band(-1.0, {-3.0, -1.0, 1.0}, 0.9);
  // Student's 95 % quantile for two degrees of freedom, 2.91999, times 2 sqrt(4/3), about -1.
  const double reach = 2.9199855804 * 2.0 * std::sqrt(4.0 / 3.0);
  EXPECT_NEAR(band.lower, -1.0 - reach, 1e-6);
  EXPECT_NEAR(band.upper, -1.0 + reach, 1e-6);
  EXPECT_EQ(band.minimum, -3.0);
  EXPECT_EQ(band.largest, 1.0);
  EXPECT_THROW(signed_plant_band(0.0, {1.0, 2.0}, 0.9), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
