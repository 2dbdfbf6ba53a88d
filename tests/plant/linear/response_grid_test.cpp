#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_values.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::plant {
namespace {

template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

bool rises(const Eigen::ArrayXd& grid) {
  return (grid.tail(grid.size() - 1) > grid.head(grid.size() - 1)).all();
}

double ratio(const Eigen::ArrayXd& grid, Eigen::Index i) {
  return grid[i + 1] / grid[i];
}

TEST(ResponseGrid, ReachesBeyondTheSlowestAndTheFastestPole) {
  // Poles 0, -0.01 and -300.
  const auto system = rational({1.0}, {0.0, 3.0, 300.01, 1.0}, "u", "y", "x");
  const Eigen::ArrayXd grid = response_grid(system);
  EXPECT_TRUE(rises(grid));
  EXPECT_NEAR(grid[0], 1e-4, 1e-8);
  EXPECT_NEAR(grid[grid.size() - 1], 3e4, 1.0);
  for (Eigen::Index i = 0; i + 1 < grid.size(); ++i) {
    EXPECT_LT(ratio(grid, i), std::pow(10.0, 1.0 / 50) * (1.0 + 1e-12));
  }
}

TEST(ResponseGrid, KeepsTheLimitsGiven) {
  const auto system = rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  const Eigen::ArrayXd grid = response_grid(system, {.lowest = 0.3, .highest = 7.0});
  EXPECT_EQ(grid[0], 0.3);
  EXPECT_EQ(grid[grid.size() - 1], 7.0);
}

TEST(ResponseGrid, LeavesNoLargeStepInTheResponseNextToALightlyDampedPole) {
  // However light the damping, from one point to the next the response changes by less than a
  // third of the larger of the two.
  for (const double damping : {0.3, 1e-2, 1e-4, 1e-6}) {
    const auto system = rational({1.0}, {1.0, 2.0 * damping, 1.0}, "u", "y", "x");
    const Eigen::ArrayXd grid = response_grid(system);
    EXPECT_TRUE(rises(grid));
    EXPECT_LT(grid.size(), 500);
    Eigen::ArrayXcd value;
    DenseResponse(system).evaluate(grid, value);
    for (Eigen::Index i = 0; i + 1 < grid.size(); ++i) {
      EXPECT_LT(std::abs(value[i + 1] - value[i]),
                0.34 * std::max(std::abs(value[i]), std::abs(value[i + 1])))
          << "damping " << damping << " at " << grid[i];
    }
    EXPECT_GT(value.abs().maxCoeff(), 0.5 / damping * 0.999);
  }
}

TEST(ResponseGrid, OfAnUndampedPoleStaysFinite) {
  const auto system = rational({1.0}, {4.0, 0.0, 1.0}, "u", "y", "x");
  const Eigen::ArrayXd grid = response_grid(system);
  EXPECT_TRUE(rises(grid));
  EXPECT_LT(grid.size(), 500);
}

TEST(ResponseGrid, OfASampledSystemEndsAtTheNyquistFrequency) {
  const double sample_time = 0.02, nyquist = std::numbers::pi / sample_time;
  // z = e^(s T) of s = -1 and -0.5 +- 100j, a delay, and a pole next to z = -1.
  const std::complex<double> turning = std::exp(std::complex<double>{-0.5, 100.0} * sample_time);
  Eigen::VectorXcd poles(5);
  poles << std::exp(-sample_time), turning, std::conj(turning), 0.0, -0.999;
  const Eigen::VectorXcd equivalent = continuous_equivalent(poles, sample_time);
  EXPECT_NEAR(equivalent[0].real(), -1.0, 1e-13);
  EXPECT_NEAR(equivalent[1].imag(), 100.0, 1e-11);
  EXPECT_TRUE(std::isinf(equivalent[3].real()));
  EXPECT_DOUBLE_EQ(equivalent[4].imag(), nyquist);
  const Eigen::ArrayXd grid = response_grid(poles, sample_time);
  EXPECT_TRUE(rises(grid));
  EXPECT_NEAR(grid[0], 0.01, 1e-12);
  EXPECT_EQ(grid[grid.size() - 1], nyquist);
  // Steps of a quarter of 0.5 rad/s next to 100 rad/s, and of -ln(0.999)/(4 T) below pi/T.
  Eigen::Index at = 0;
  (grid - 100.0).abs().minCoeff(&at);
  EXPECT_NEAR(grid[at + 1] - grid[at], 0.125, 1e-9);
  EXPECT_NEAR(grid[grid.size() - 1] - grid[grid.size() - 2], 0.25 * -equivalent[4].real(), 1e-9);
  EXPECT_EQ(response_grid(poles, sample_time, {.highest = 1e6}).tail(1)[0], nyquist);
}

TEST(ResponseGrid, WithoutPolesHasADefaultRange) {
  const auto gain = static_gain(Eigen::MatrixXd::Ones(1, 1), {"u"}, {"y"});
  const Eigen::ArrayXd grid = response_grid(gain);
  EXPECT_DOUBLE_EQ(grid[0], 0.01);
  EXPECT_DOUBLE_EQ(grid[grid.size() - 1], 100.0);
  const Eigen::ArrayXd sampled = response_grid(Eigen::VectorXcd(0), 0.1);
  EXPECT_DOUBLE_EQ(sampled[sampled.size() - 1], 10.0 * std::numbers::pi);
  EXPECT_LT(sampled[0], sampled[1]);
}

TEST(ResponseGrid, TakesNoStepLongerThanAsked) {
  const auto system = rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  const Eigen::ArrayXd grid = response_grid(system, {.longest_step = 0.25});
  EXPECT_TRUE(rises(grid));
  EXPECT_LE((grid.tail(grid.size() - 1) - grid.head(grid.size() - 1)).maxCoeff(),
            0.25 * (1.0 + 1e-12));
}

TEST(ResponseGrid, RefusesWhatIsNoGrid) {
  const auto system = rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  EXPECT_THAT(message_of([&] { response_grid(system, {.lowest = 2.0, .highest = 1.0}); }),
              testing::HasSubstr("expected lowest < highest, found 2 and 1 rad/s"));
  EXPECT_THAT(message_of([&] { response_grid(system, {.lowest = -1.0}); }),
              testing::HasSubstr("expected limits of 0 (chosen) or more, found -1"));
  EXPECT_THAT(message_of([&] { response_grid(system, {.points_per_decade = 0}); }),
              testing::HasSubstr("at least 1 point a decade"));
  EXPECT_THAT(message_of([&] { response_grid(system, {.longest_step = 1e-6}); }),
              testing::HasSubstr("more than four million points"));
  EXPECT_THAT(message_of([&] { response_grid(Eigen::VectorXcd(0), -1.0); }),
              testing::HasSubstr("expected a sample time of 0 (continuous) or more, found -1 s"));
  const Eigen::VectorXcd nothing =
      Eigen::VectorXcd::Constant(1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(message_of([&] { response_grid(nothing, 0.0); }),
              testing::HasSubstr("the features have elements that are not finite"));
}

}  // namespace
}  // namespace boresight::plant
