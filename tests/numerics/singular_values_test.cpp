#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/singular_values.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

TEST(SingularValues, MultiplyToTheMatrix) {
  reference::RandomNumbers random(111);
  for (int trial = 0; trial < 20; ++trial) {
    const Index rows = random.integer(1, 9), columns = random.integer(1, 9);
    const MatrixXd matrix = random.matrix(rows, columns);
    const numerics::SingularValues svd = numerics::singular_values(matrix);
    const Index k = std::min(rows, columns);
    EXPECT_LT((svd.u * svd.values.asDiagonal() * svd.v.transpose() - matrix).norm(), 1e-14 * 10);
    EXPECT_LT((svd.u.transpose() * svd.u - MatrixXd::Identity(k, k)).norm(), 1e-13);
    EXPECT_LT((svd.v.transpose() * svd.v - MatrixXd::Identity(k, k)).norm(), 1e-13);
    for (Index i = 1; i < k; ++i) EXPECT_GE(svd.values[i - 1], svd.values[i]);
  }
}

TEST(SingularValues, KeepTheDigitsOfSmallOnes) {
  // Columns of sizes 1, 1e-20, 1e-40 that are orthogonal in pairs of powers of two.
  MatrixXd matrix(3, 3);
  matrix << 1.0, 1e-20, 1e-40, 1.0, -1e-20, 1e-40, 1.0, 0.0, -2e-40;
  const numerics::SingularValues svd = numerics::singular_values(matrix);
  EXPECT_NEAR(svd.values[0], std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(svd.values[1] / 1e-20, std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(svd.values[2] / 1e-40, std::sqrt(6.0), 1e-14);
}

TEST(SingularValues, OfNothingAndOfWhatIsNotFinite) {
  EXPECT_EQ(numerics::singular_values(MatrixXd(0, 3)).values.size(), 0);
  EXPECT_EQ(numerics::singular_values(MatrixXd(0, 3)).v.rows(), 3);
  EXPECT_THROW(numerics::singular_values(MatrixXd::Constant(2, 2, std::nan(""))), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
