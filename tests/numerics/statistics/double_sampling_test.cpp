#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/statistics/double_sampling.hpp>

namespace boresight::numerics {
namespace {

using Eigen::VectorXd;

TEST(DoubleSampling, IsExactOnALine) {
  const VectorXd x = VectorXd::LinSpaced(50, 1.0, 9.0);
  const VectorXd y = 2.0 + 3.0 * x.head(10).array();
  const Interval mean = mean_by_double_sampling(y, x);
  EXPECT_NEAR(mean.value, 2.0 + 3.0 * 5.0, 1e-12);
  // What is left is that of the mean of all x.
  const VectorXd dy = y.array() - y.mean();
  EXPECT_NEAR(mean.standard_uncertainty, std::sqrt(dy.squaredNorm() / 9.0 / 50.0), 1e-9);
}

TEST(DoubleSampling, IsTheMeanWithStudentsIntervalWhereTheAuxiliaryIsConstant) {
  VectorXd y(6);
  y << 1.0, 3.0, 2.0, 5.0, 4.0, 3.0;
  const Interval mean = mean_by_double_sampling(y, VectorXd::Constant(1000000, 7.0));
  EXPECT_NEAR(mean.value, 3.0, 1e-12);
  const double residual = 10.0 / 4.0;
  EXPECT_NEAR(mean.standard_uncertainty, std::sqrt(residual / 6.0), 1e-6);
  EXPECT_NEAR(mean.upper - mean.value, 2.7764451 * mean.standard_uncertainty, 1e-6);
}

TEST(DoubleSampling, CoversTheMeanAndIsNarrowerThanWithoutTheAuxiliary) {
  // y = x + e with a twentieth of the variance in e: mean 3, exact.
  constexpr int repetitions = 1000, few = 10, many = 100;
  int covered = 0;
  double width = 0.0;
  const NormalNumbers numbers(7);
  std::uint64_t drawn = 0;
  for (int r = 0; r < repetitions; ++r) {
    VectorXd x(many), y(few);
    for (int i = 0; i < many; ++i) {
      const auto pair = numbers.pair(drawn++);
      x[i] = 3.0 + pair.real();
      if (i < few) y[i] = x[i] + std::sqrt(0.05) * pair.imag();
    }
    const Interval mean = mean_by_double_sampling(y, x);
    if (mean.lower <= 3.0 && 3.0 <= mean.upper) ++covered;
    width += mean.standard_uncertainty / repetitions;
  }
  // 95 % of 1000, +- 3 standard deviations of a binomial count.
  EXPECT_NEAR(covered, 950, 21);
  EXPECT_LT(width, 0.5 / std::sqrt(10.0));
}

TEST(DoubleSampling, RefusesWhatTellsNothing) {
  const VectorXd three = VectorXd::Ones(3), five = VectorXd::Ones(5);
  EXPECT_THROW(mean_by_double_sampling(three, five), InvalidInput);
  EXPECT_THROW(mean_by_double_sampling(five, VectorXd::Ones(4)), InvalidInput);
  VectorXd broken = five;
  broken[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(mean_by_double_sampling(broken, five), InvalidInput);
}

}  // namespace
}  // namespace boresight::numerics
