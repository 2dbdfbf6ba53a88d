#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(SemidefiniteFactor, SquaredIsTheMatrixAndItsWidthTheRank) {
  reference::RandomNumbers random(81);
  for (int trial = 0; trial < 60; ++trial) {
    const Index n = random.integer(1, 12);
    const Index rank = random.integer(0, static_cast<int>(n));
    MatrixXd root = random.matrix(n, rank);
    // Units that differ by many powers of ten do not change the rank.
    for (Index i = 0; i < n; ++i) root.row(i) *= random.log_uniform(1e-12, 1e12);
    const MatrixXd q = root * root.transpose();
    const MatrixXd factor = numerics::semidefinite_factor(q, "test");
    EXPECT_EQ(factor.cols(), rank);
    const MatrixXd error = factor * factor.transpose() - q;
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        EXPECT_LE(std::abs(error(i, j)), 1e-13 * std::sqrt(q(i, i) * q(j, j)));
      }
    }
  }
}

TEST(SemidefiniteFactor, OfNothingAndOfZero) {
  EXPECT_EQ(numerics::semidefinite_factor(MatrixXd(0, 0), "test").size(), 0);
  EXPECT_EQ(numerics::semidefinite_factor(MatrixXd::Zero(3, 3), "test").cols(), 0);
}

TEST(SemidefiniteFactor, RefusesWhatIsNotSemidefinite) {
  MatrixXd saddle(2, 2);
  saddle << 1.0, 2.0, 2.0, 1.0;
  EXPECT_THAT(reference::Call([&] { numerics::semidefinite_factor(saddle, "weight Q"); }),
              ThrowsMessage<InvalidInput>(
                  HasSubstr("weight Q: expected a positive semidefinite matrix, found -3")));
  MatrixXd hollow(2, 2);
  hollow << 0.0, 1.0, 1.0, 0.0;
  EXPECT_THROW(numerics::semidefinite_factor(hollow, "Q"), InvalidInput);
  EXPECT_THAT(
      reference::Call([] { numerics::semidefinite_factor(-MatrixXd::Identity(2, 2), "Q"); }),
      ThrowsMessage<InvalidInput>(HasSubstr("at row 1")));
  MatrixXd skew = MatrixXd::Identity(2, 2);
  skew(0, 1) = 1e-3;
  EXPECT_THAT(reference::Call([&] { numerics::semidefinite_factor(skew, "Q"); }),
              ThrowsMessage<InvalidInput>(HasSubstr("antisymmetric part")));
  EXPECT_THAT(reference::Call([] { numerics::semidefinite_factor(MatrixXd::Ones(2, 3), "Q"); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 2 x 3")));
  EXPECT_THROW(numerics::semidefinite_factor(saddle * std::nan(""), "Q"), InvalidInput);
}

TEST(PositiveDefiniteSolve, SolvesInAnyUnits) {
  reference::RandomNumbers random(82);
  for (int trial = 0; trial < 30; ++trial) {
    const Index n = random.integer(1, 8);
    const MatrixXd root = random.matrix(n, n + 3);
    const MatrixXd p = root * root.transpose();
    const MatrixXd x = random.matrix(n, 2);
    Eigen::VectorXd unit(n);
    for (Index i = 0; i < n; ++i) unit[i] = random.log_uniform(1e-20, 1e20);
    const MatrixXd found = numerics::positive_definite_solve(
        unit.asDiagonal() * p * unit.asDiagonal(), unit.asDiagonal() * (p * x), "test");
    EXPECT_LT((unit.asDiagonal() * found - x).norm(), 1e-9 * x.norm());
  }
  EXPECT_EQ(numerics::positive_definite_solve(MatrixXd(0, 0), MatrixXd(0, 2), "test").cols(), 2);
}

TEST(PositiveDefiniteSolve, RefusesWhatIsNotPositiveDefinite) {
  EXPECT_THAT(reference::Call([] {
                numerics::positive_definite_solve(MatrixXd::Ones(2, 2), MatrixXd::Ones(2, 1), "R");
              }),
              ThrowsMessage<NumericalFailure>(HasSubstr("R: the matrix is singular")));
  EXPECT_THAT(reference::Call([] {
                numerics::positive_definite_solve(MatrixXd::Zero(2, 2), MatrixXd::Ones(2, 1), "R");
              }),
              ThrowsMessage<NumericalFailure>(HasSubstr("found 0 on its diagonal")));
  EXPECT_THAT(reference::Call([] {
                numerics::positive_definite_solve(MatrixXd::Ones(2, 2), MatrixXd::Ones(3, 1), "R");
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("2 x 2 and 3 rows")));
}

}  // namespace
}  // namespace boresight::plant
