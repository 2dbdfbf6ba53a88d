#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/grouped_regression.hpp>

namespace boresight::numerics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index rows = 400;

std::vector<Index> groups() {
  std::vector<Index> group;
  for (Index row = 0; row < rows; ++row) group.push_back(row / 20);
  return group;
}

VectorXd noise(std::uint64_t seed) {
  const NormalNumbers normal(seed, 0);
  VectorXd values(rows);
  for (Index i = 0; i < rows; ++i) values(i) = normal.pair(static_cast<std::uint64_t>(i)).real();
  return values;
}

MatrixXd line() {
  MatrixXd regressors(rows, 2);
  regressors.col(0) = VectorXd::LinSpaced(rows, -3.0, 3.0).array().sin();
  regressors.col(1).setOnes();
  return regressors;
}

TEST(GroupedRegression, FitsAnExactLine) {
  const MatrixXd x = line();
  const auto found = grouped_regression(x, x * Eigen::Vector2d(2.0, -1.0), groups());
  EXPECT_NEAR(found.coefficients(0), 2.0, 1e-12);
  EXPECT_NEAR(found.coefficients(1), -1.0, 1e-12);
  EXPECT_TRUE(found.determined[0] && found.determined[1]);
  EXPECT_EQ(found.degrees_of_freedom, 19.0);
}

TEST(GroupedRegression, CoversTheTruthWhereErrorsAreCorrelatedWithinGroups) {
  int covered = 0;
  constexpr int trials = 300;
  const MatrixXd x = line();
  for (int trial = 0; trial < trials; ++trial) {
    VectorXd errors = noise(static_cast<std::uint64_t>(trial));
    for (Index i = 1; i < rows; ++i) errors(i) += 0.8 * errors(i - 1);
    const auto found = grouped_regression(x, x * Eigen::Vector2d(2.0, -1.0) + errors, groups());
    const double half =
        student_quantile(0.975, found.degrees_of_freedom) * std::sqrt(found.covariance(0, 0));
    if (std::abs(found.coefficients(0) - 2.0) <= half) ++covered;
  }
  EXPECT_GE(covered, 0.90 * trials);
  EXPECT_LE(covered, 0.99 * trials);
}

TEST(GroupedRegression, SubtractsTheRegressorsNoise) {
  const MatrixXd x = line();
  MatrixXd noisy = x;
  noisy.col(0) += 0.5 * noise(7);
  const VectorXd response = x * Eigen::Vector2d(2.0, -1.0);
  const auto biased = grouped_regression(noisy, response, groups());
  const auto found = grouped_regression(noisy, response, groups(), Eigen::Vector2d(0.25, 0.0));
  EXPECT_LT(biased.coefficients(0), 1.7);
  EXPECT_NEAR(found.coefficients(0), 2.0, 0.15);
}

TEST(GroupedRegression, LeavesOutliersOut) {
  const MatrixXd x = line();
  VectorXd response = x * Eigen::Vector2d(2.0, -1.0) + 0.01 * noise(8);
  for (Index i = 0; i < rows; i += 10) response(i) += 50.0;
  const auto found = grouped_regression(x, response, groups());
  EXPECT_NEAR(found.coefficients(0), 2.0, 0.01);
  EXPECT_NEAR(found.coefficients(1), -1.0, 0.01);
}

TEST(GroupedRegression, SaysWhichCoefficientsItCannotTellApart) {
  MatrixXd x(rows, 3);
  x.leftCols(2) = line();
  x.col(2) = 3.0 * x.col(1);
  const auto found = grouped_regression(x, noise(9), groups());
  EXPECT_TRUE(found.determined[0]);
  EXPECT_FALSE(found.determined[1]);
  EXPECT_FALSE(found.determined[2]);
}

TEST(GroupedRegression, RefusesWhatDoesNotFit) {
  const MatrixXd x = line();
  EXPECT_THROW(grouped_regression(x, VectorXd::Zero(3), groups()), InvalidInput);
  EXPECT_THROW(grouped_regression(x, VectorXd::Zero(rows), std::vector<Index>(rows, 0)),
               InvalidInput);
  EXPECT_THROW(grouped_regression(x, VectorXd::Constant(rows, std::nan("")), groups()),
               InvalidInput);
}

}  // namespace
}  // namespace boresight::numerics
