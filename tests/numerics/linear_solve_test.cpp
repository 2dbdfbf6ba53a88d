#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(LinearSolve, LeavesNoResidual) {
  reference::RandomNumbers random(11);
  for (const Eigen::Index n : {1, 2, 5, 17}) {
    const Eigen::MatrixXd matrix = random.matrix(n, n);
    const Eigen::MatrixXd right = random.matrix(n, 3);
    const Eigen::MatrixXd x = numerics::linear_solve(matrix, right, "trial");
    EXPECT_LT((matrix * x - right).norm(), 1e-13 * matrix.norm() * x.norm());
  }
}

TEST(LinearSolve, GivesTheClosedFormOfTwoUnknowns) {
  Eigen::Matrix2d matrix;
  matrix << 2.0, 3.0, 5.0, 7.0;  // determinant -1
  Eigen::Matrix2d inverse;
  inverse << -7.0, 3.0, 5.0, -2.0;
  EXPECT_LT((numerics::linear_solve(matrix, Eigen::Matrix2d::Identity(), "trial") - inverse).norm(),
            1e-13);
}

TEST(LinearSolve, NamesTheCallerOfASingularMatrix) {
  Eigen::Matrix3d singular;
  singular << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  EXPECT_THAT(
      reference::Call([&] { numerics::linear_solve(singular, Eigen::Vector3d::Ones(), "caller"); }),
      ThrowsMessage<NumericalFailure>(HasSubstr("caller: the matrix is singular")));
  EXPECT_THROW(numerics::linear_solve(Eigen::Matrix2d::Zero(), Eigen::Vector2d::Ones(), "caller"),
               NumericalFailure);
  EXPECT_THROW(
      numerics::linear_solve(Eigen::Matrix2d::Constant(std::nan("")), Eigen::Vector2d::Ones(), "c"),
      NumericalFailure);
}

TEST(LinearSolve, RefusesShapesThatDoNotFit) {
  EXPECT_THAT(reference::Call([] {
                numerics::linear_solve(Eigen::MatrixXd::Ones(2, 3), Eigen::MatrixXd::Ones(2, 1),
                                       "x");
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 2 x 3")));
  EXPECT_THROW(
      numerics::linear_solve(Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Ones(3, 1), "x"),
      InvalidInput);
}

TEST(LinearSolve, PassesNoUnknownsThrough) {
  EXPECT_EQ(numerics::linear_solve(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 2), "x").cols(), 2);
}

TEST(TransferMatrix, IsThatOfASecondOrderLag) {
  const double w0 = 3.0, zeta = 0.2;
  Eigen::Matrix2d a;
  a << 0.0, 1.0, -w0 * w0, -2.0 * zeta * w0;
  const Eigen::Vector2d b{0.0, w0 * w0};
  const Eigen::RowVector2d c{1.0, 0.5};
  const Eigen::MatrixXd d = Eigen::MatrixXd::Constant(1, 1, 0.25);
  for (const std::complex<double> s :
       {std::complex<double>{0.0, 0.0}, {0.0, 2.9}, {0.0, 100.0}, {-0.4, 1.3}, {2.0, 0.0}}) {
    const std::complex<double> expected =
        w0 * w0 * (1.0 + 0.5 * s) / (s * s + 2.0 * zeta * w0 * s + w0 * w0) + 0.25;
    EXPECT_LT(reference::relative_error(numerics::transfer_matrix(a, b, c, d, s)(0, 0), expected),
              1e-13);
  }
}

TEST(TransferMatrix, DoesNotDependOnTheStateBasis) {
  reference::RandomNumbers random(12);
  const Eigen::MatrixXd a = random.matrix(5, 5), b = random.matrix(5, 2), c = random.matrix(3, 5),
                        d = random.matrix(3, 2);
  const Eigen::MatrixXd basis = random.matrix(5, 5) + 3.0 * Eigen::MatrixXd::Identity(5, 5);
  const Eigen::MatrixXd inverse =
      numerics::linear_solve(basis, Eigen::MatrixXd::Identity(5, 5), "basis");
  const std::complex<double> s{0.3, 1.7};
  const Eigen::MatrixXcd one = numerics::transfer_matrix(a, b, c, d, s);
  const Eigen::MatrixXcd other =
      numerics::transfer_matrix(inverse * a * basis, inverse * b, c * basis, d, s);
  EXPECT_LT((one - other).norm(), 1e-12 * one.norm());
}

}  // namespace
}  // namespace boresight::plant
