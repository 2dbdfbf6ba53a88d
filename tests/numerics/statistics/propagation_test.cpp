#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/propagation.hpp>

namespace boresight::identification {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Point = std::span<const double>;

constexpr double z = 1.959963984540054;  // 97.5 % of the standard normal

const std::vector<numerics::UncertainInput> inputs{
    {"a", 2.0, 0.1}, {"b", 5.0, 0.4}, {"exact", 3.0, 0.0}};

double product(Point x) {
  return x[0] * x[1] * x[1] / x[2];
}

TEST(Propagate, FirstOrderOfAProductAddsRelativeUncertainties) {
  const auto result = numerics::propagate(inputs, {{"product", product}})[0];
  EXPECT_EQ(result.name, "product");
  EXPECT_DOUBLE_EQ(result.value, 50.0 / 3.0);
  const double of_a = 0.05, of_b = 2.0 * 0.08;
  EXPECT_NEAR(result.standard_uncertainty, result.value * std::hypot(of_a, of_b), 1e-7);
  ASSERT_EQ(result.contributions.size(), 2u);
  EXPECT_EQ(result.contributions[0].input, "b");
  const double fraction = of_b * of_b / (of_a * of_a + of_b * of_b);
  EXPECT_NEAR(result.contributions[0].fraction, fraction, 1e-8);
  EXPECT_NEAR(result.contributions[1].fraction, 1.0 - fraction, 1e-8);
}

TEST(Propagate, IntervalOfAProductIsTheLogNormalOne) {
  numerics::PropagationOptions options;
  options.random_samples = 200000;
  const auto result = numerics::propagate(inputs, {{"product", product}}, options)[0];
  const double spread = std::hypot(0.05, 2.0 * 0.08);
  // Standard error of a 97.5 % quantile of n normal samples: sqrt(p(1-p)/n)/density.
  const double error = std::sqrt(0.025 * 0.975 / options.random_samples) / 0.0584 * spread;
  EXPECT_NEAR(std::log(result.lower / result.value), -z * spread, 4.0 * error);
  EXPECT_NEAR(std::log(result.upper / result.value), z * spread, 4.0 * error);
}

TEST(Propagate, OfTheInputItselfIsTheInput) {
  const auto result =
      numerics::propagate({{"a", 7.0, 0.7}}, {{"a", [](Point x) { return x[0]; }}})[0];
  EXPECT_DOUBLE_EQ(result.value, 7.0);
  EXPECT_NEAR(result.standard_uncertainty, 0.7, 1e-9);
  EXPECT_NEAR(std::log(result.upper / 7.0), z * 0.1, 0.005);
  EXPECT_GT(result.lower, 0.0);
}

TEST(Propagate, WithoutUncertaintyHasAnIntervalOfNoWidth) {
  const auto result =
      numerics::propagate({{"a", 2.0, 0.0}}, {{"square", [](Point x) { return x[0] * x[0]; }}})[0];
  EXPECT_DOUBLE_EQ(result.value, 4.0);
  EXPECT_EQ(result.standard_uncertainty, 0.0);
  EXPECT_EQ(result.lower, result.upper);
  EXPECT_TRUE(result.contributions.empty());
}

TEST(Propagate, CarriesAReciprocalThroughItsPole) {
  // g = x - 1, x log-normal about 1.1: 1/g has a pole at x = 1, beyond it lies P(ln x < 0).
  const auto difference = [](Point x) { return x[0] - 1.0; };
  numerics::PropagationOptions options;
  options.random_samples = 100000;
  const auto result =
      numerics::propagate({{"x", 1.1, 0.11}}, {{"ratio", difference, true}}, options)[0];
  EXPECT_NEAR(result.value, 10.0, 1e-12);
  EXPECT_NEAR(result.standard_uncertainty, 0.11 * 100.0, 1e-5);  // d(1/g) = dg/g^2
  const double beyond = 0.5 * std::erfc(std::log(1.1) / 0.1 / std::sqrt(2.0));
  EXPECT_NEAR(result.beyond_pole, beyond, 4.0 * std::sqrt(beyond * (1.0 - beyond) / 1e5));
  EXPECT_EQ(result.upper, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(result.lower, 1.0 / (1.1 * std::exp(z * 0.1) - 1.0), 0.05);
}

TEST(Propagate, OfAReciprocalFarFromItsPoleIsThatOfTheQuotient) {
  const std::vector<numerics::PropagationTarget> targets{
      {"direct", [](Point x) { return 1.0 / x[0]; }},
      {"reciprocal", [](Point x) { return x[0]; }, true}};
  const auto results = numerics::propagate({{"x", 4.0, 0.2}}, targets);
  EXPECT_NEAR(results[0].value, results[1].value, 1e-15);
  EXPECT_NEAR(results[0].standard_uncertainty, results[1].standard_uncertainty, 1e-9);
  // Quantiles of 1/x and 1/quantiles of x interpolate between the same samples.
  EXPECT_NEAR(results[0].lower / results[1].lower, 1.0, 1e-5);
  EXPECT_NEAR(results[0].upper / results[1].upper, 1.0, 1e-5);
  EXPECT_EQ(results[1].beyond_pole, 0.0);
}

TEST(Propagate, SharesAddToOneWithSmallOnesLeftOut) {
  std::vector<numerics::UncertainInput> many;
  for (int i = 0; i < 10; ++i) {
    many.push_back({"input " + std::to_string(i), 1.0, 0.1 * std::pow(0.6, i)});
  }
  const auto result = numerics::propagate(
      many, {{"sum", [](Point x) { return std::accumulate(x.begin(), x.end(), 0.0); }}})[0];
  double sum = 0.0;
  for (std::size_t i = 0; i < result.contributions.size(); ++i) {
    EXPECT_GE(result.contributions[i].fraction, 0.01);
    sum += result.contributions[i].fraction;
    if (i == 0) continue;
    EXPECT_LE(result.contributions[i].fraction, result.contributions[i - 1].fraction);
  }
  EXPECT_LT(result.contributions.size(), many.size());
  EXPECT_LE(sum, 1.0 + 1e-12);
  EXPECT_GT(sum, 0.97);
}

TEST(Propagate, IsTheSameForTheSameSeedAlone) {
  const std::vector<numerics::PropagationTarget> targets{{"product", product}};
  const auto once = numerics::propagate(inputs, targets, {5000, 7})[0];
  const auto again = numerics::propagate(inputs, targets, {5000, 7})[0];
  const auto other = numerics::propagate(inputs, targets, {5000, 8})[0];
  EXPECT_EQ(once.lower, again.lower);
  EXPECT_EQ(once.upper, again.upper);
  EXPECT_NE(once.lower, other.lower);
  EXPECT_EQ(once.standard_uncertainty, other.standard_uncertainty);
}

TEST(Propagate, DoesNotDependOnTheUnit) {
  const auto feet =
      numerics::propagate({{"x", 2.0, 0.1}}, {{"x", [](Point x) { return x[0]; }}})[0];
  const auto inches =
      numerics::propagate({{"x", 24.0, 1.2}}, {{"x", [](Point x) { return x[0]; }}})[0];
  EXPECT_NEAR(inches.lower, 12.0 * feet.lower, 1e-12);
  EXPECT_NEAR(inches.upper, 12.0 * feet.upper, 1e-12);
}

TEST(Propagate, NamesTheInputItRefuses) {
  const std::vector<numerics::PropagationTarget> targets{{"x", [](Point x) { return x[0]; }}};
  EXPECT_THAT(reference::Call([&] {
                numerics::propagate({{"length", -1.0, 0.1}}, targets);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("'length'")));
  EXPECT_THROW(numerics::propagate({{"x", 1.0, -0.1}}, targets), InvalidInput);
  EXPECT_THROW(numerics::propagate({{"x", std::nan(""), 0.1}}, targets), InvalidInput);
  EXPECT_THAT(reference::Call([&] {
                numerics::propagate({{"x", 1.0, 0.1}}, targets, {99, 1});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least 100 samples")));
}

}  // namespace
}  // namespace boresight::identification
