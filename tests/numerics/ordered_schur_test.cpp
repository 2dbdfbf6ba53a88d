#include <cmath>
#include <complex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/ordered_schur.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(OrderedSchur, PutsTheChosenEigenvaluesFirstAndKeepsTheMatrix) {
  reference::RandomNumbers random(51);
  for (int trial = 0; trial < 50; ++trial) {
    const Index n = random.integer(1, 16);
    const MatrixXd a = random.matrix(n, n);
    numerics::ComplexSchur schur = numerics::complex_schur(numerics::real_schur(a));
    const Eigen::VectorXcd before = schur.t.diagonal();
    const auto left = [](Complex value) { return value.real() < 0.0; };
    const Index leading = numerics::order_schur(schur, left);
    EXPECT_LT((schur.u * schur.t * schur.u.adjoint() - a).norm(), 1e-13 * a.norm());
    EXPECT_LT((schur.u.adjoint() * schur.u - MatrixXcd::Identity(n, n)).norm(), 1e-13);
    EXPECT_EQ(schur.t.triangularView<Eigen::StrictlyLower>().toDenseMatrix().norm(), 0.0);
    // The same numbers, each group in its old order.
    Index first = 0, second = leading;
    for (Index i = 0; i < n; ++i) {
      const Index now = left(before[i]) ? first++ : second++;
      EXPECT_EQ(schur.t(now, now), before[i]);
    }
    EXPECT_EQ(first, leading);
  }
}

TEST(OrderedSchur, DecouplesTheTwoGroups) {
  reference::RandomNumbers random(52);
  for (int trial = 0; trial < 20; ++trial) {
    const Index n = random.integer(2, 12);
    numerics::ComplexSchur schur =
        numerics::complex_schur(numerics::real_schur(random.matrix(n, n)));
    const Index leading =
        numerics::order_schur(schur, [](Complex value) { return std::abs(value) < 0.7; });
    const MatrixXcd y = numerics::decoupling(schur.t, leading);
    MatrixXcd basis = MatrixXcd::Identity(n, n);
    basis.topRightCorner(leading, n - leading) = y;
    MatrixXcd diagonal = schur.t;
    diagonal.topRightCorner(leading, n - leading).setZero();
    EXPECT_LT((schur.t * basis - basis * diagonal).norm(), 1e-12 * (1.0 + y.norm()));
  }
  EXPECT_EQ(numerics::decoupling(MatrixXcd::Identity(3, 3), 3).cols(), 0);
  EXPECT_EQ(numerics::decoupling(MatrixXcd::Identity(3, 3), 0).rows(), 0);
}

TEST(OrderedSchur, RefusesToDecoupleACommonEigenvalue) {
  MatrixXcd jordan = MatrixXcd::Identity(2, 2) * 0.5;
  jordan(0, 1) = 1.0;
  EXPECT_THAT(reference::Call([&] { numerics::decoupling(jordan, 1); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("found 0.5 + 0 j in both")));
}

TEST(OrderedSchur, OfNothing) {
  numerics::ComplexSchur empty = numerics::complex_schur(numerics::real_schur(MatrixXd(0, 0)));
  EXPECT_EQ(numerics::order_schur(empty, [](Complex) { return true; }), 0);
}

}  // namespace
}  // namespace boresight::plant
