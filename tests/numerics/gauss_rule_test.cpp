#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/gauss_rule.hpp>

namespace boresight::plant {
namespace {

class GaussRules : public testing::TestWithParam<int> {};

double integral(const numerics::GaussRule& rule, int order) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    sum += rule.weight[i] * std::pow(rule.node[i], order);
  }
  return sum;
}

TEST_P(GaussRules, IntegratePolynomialsUpToTwiceTheirPoints) {
  const int n = GetParam();
  const auto rule = numerics::gauss_rule(n);
  for (int order = 0; order < 2 * n; ++order) {
    EXPECT_NEAR(integral(rule, order), order % 2 == 0 ? 2.0 / (order + 1.0) : 0.0, 4e-15) << order;
  }
}

TEST_P(GaussRules, AreSymmetricAndAscendingWithWeightsThatSumToTwo) {
  const auto rule = numerics::gauss_rule(GetParam());
  const std::size_t n = rule.node.size();
  ASSERT_EQ(n, static_cast<std::size_t>(GetParam()));
  EXPECT_NEAR(std::accumulate(rule.weight.begin(), rule.weight.end(), 0.0), 2.0, 1e-14);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(rule.node[i], -rule.node[n - 1 - i]);
    EXPECT_EQ(rule.weight[i], rule.weight[n - 1 - i]);
    EXPECT_GT(rule.weight[i], 0.0);
    EXPECT_LT(i == 0 ? -1.0 : rule.node[i - 1], rule.node[i]);
  }
}

// The polynomial through the values of one of degree n - 1 is that one.
TEST_P(GaussRules, InterpolateByTheirBarycentricWeights) {
  const int n = GetParam();
  const auto rule = numerics::gauss_rule(n);
  for (const double x : {-0.97, 0.123, 0.6}) {
    double above = 0.0, below = 0.0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double fraction = rule.barycentric[i] / (x - rule.node[i]);
      above += fraction * std::pow(rule.node[i], n - 1);
      below += fraction;
    }
    EXPECT_NEAR(above / below, std::pow(x, n - 1), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, GaussRules, testing::Values(1, 2, 3, 4, 5, 8, 16, 32, 48, 128));

// The first degree that a rule gets wrong, by (2^(n+1) (n!)^2/(2n)!)^2/(2 (2n+1)).
TEST(GaussRule, IsWrongByItsErrorTermBeyondThat) {
  for (int n = 1; n < 20; ++n) {
    double factor = 2.0;
    for (int k = 1; k <= n; ++k) factor *= 2.0 * k / (n + k);
    EXPECT_NEAR(2.0 / (2.0 * n + 1.0) - integral(numerics::gauss_rule(n), 2 * n),
                factor * factor / (2.0 * (2.0 * n + 1.0)), 4e-15)
        << n;
  }
}

TEST(GaussRule, RefusesOtherNumbersOfPoints) {
  EXPECT_THROW(numerics::gauss_rule(0), InvalidInput);
  EXPECT_THROW(numerics::gauss_rule(-3), InvalidInput);
  EXPECT_THROW(numerics::gauss_rule(501), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
