#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::design {
namespace {

TEST(DistributionQuantiles, AgreeWithClosedForms) {
  for (const double fraction : {1e-6, 0.01, 0.3, 0.5, 0.8, 0.999}) {
    // One degree of freedom: Cauchy's; two: (2 p - 1)/sqrt(2 p (1 - p)).
    EXPECT_NEAR(numerics::student_quantile(fraction, 1.0),
                std::tan(std::numbers::pi * (fraction - 0.5)),
                1e-10 * (1.0 + std::abs(numerics::student_quantile(fraction, 1.0))));
    EXPECT_NEAR(numerics::student_quantile(fraction, 2.0),
                (2.0 * fraction - 1.0) / std::sqrt(2.0 * fraction * (1.0 - fraction)),
                1e-10 / fraction);
    EXPECT_NEAR(numerics::beta_quantile(fraction, 1.0, 3.0),
                -std::expm1(std::log1p(-fraction) / 3.0), 1e-12);
    EXPECT_NEAR(numerics::chi_squared_quantile(fraction, 2.0), -2.0 * std::log1p(-fraction), 1e-11);
    // F of 2 and 2: p/(1 - p).
    EXPECT_NEAR(numerics::f_quantile(fraction, 2.0, 2.0) / (fraction / (1.0 - fraction)), 1.0,
                1e-11);
    // Fisher's F of 1 and n is Student's t squared.
    if (fraction > 0.5) {
      EXPECT_NEAR(numerics::f_quantile(2.0 * fraction - 1.0, 1.0, 7.0),
                  std::pow(numerics::student_quantile(fraction, 7.0), 2), 1e-9);
    }
  }
  // Tables: t of 10 degrees at 97.5 %, F of 5 and 10 at 95 %.
  EXPECT_NEAR(numerics::student_quantile(0.975, 10.0), 2.228139, 1e-6);
  EXPECT_NEAR(numerics::f_quantile(0.95, 5.0, 10.0), 3.325835, 1e-6);
  // Chi-squared at 99.9 %; the normal distribution is Student's of no end of degrees.
  const std::pair<double, double> table[] = {
      {1.0, 10.828}, {2.0, 13.816}, {10.0, 29.588}, {30.0, 59.703}};
  for (const auto& [freedom, limit] : table) {
    EXPECT_NEAR(numerics::chi_squared_quantile(0.999, freedom), limit, 5e-4) << freedom;
  }
  EXPECT_NEAR(numerics::student_quantile(0.975, 1e9), numerics::normal_975, 1e-7);
}

TEST(DistributionQuantiles, MirrorWhereTheDistributionsDo) {
  EXPECT_EQ(numerics::student_quantile(0.5, 3.0), 0.0);
  EXPECT_NEAR(numerics::student_quantile(0.25, 3.3), -numerics::student_quantile(0.75, 3.3), 1e-12);
  EXPECT_NEAR(numerics::f_quantile(0.2, 3.0, 8.0), 1.0 / numerics::f_quantile(0.8, 8.0, 3.0),
              1e-12);
  EXPECT_NEAR(numerics::beta_quantile(0.1, 2.5, 0.7), 1.0 - numerics::beta_quantile(0.9, 0.7, 2.5),
              1e-12);
}

TEST(DistributionQuantiles, SayWhatIsWrong) {
  const auto refusal = [](auto call) -> std::string {
    try {
      call();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal([] { numerics::student_quantile(97.5, 3.0); }),
              HasSubstr("student_quantile: expected a fraction within (0, 1), found 97.5"));
  EXPECT_THAT(refusal([] { numerics::student_quantile(0.5, -1.0); }), HasSubstr("found -1"));
  EXPECT_THAT(refusal([] { numerics::beta_quantile(0.0, 1.0, 1.0); }), HasSubstr("beta_quantile"));
  EXPECT_THAT(refusal([] { numerics::f_quantile(0.5, 1.0, 0.0); }),
              HasSubstr("expected positive, finite parameters, found 1 and 0"));
  EXPECT_THAT(refusal([] {
                numerics::chi_squared_quantile(0.5, std::numeric_limits<double>::quiet_NaN());
              }),
              HasSubstr("found nan"));
}

}  // namespace
}  // namespace boresight::design
